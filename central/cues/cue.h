// A target reported from outside the site. Stations may be led to it; it never changes a position
// that the fusion computes. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "central/filter/interacting_models.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

struct Cue {
  std::string id, label;
  std::int64_t utime_us = 0;  // creation time of its message
  std::int64_t state_us = 0;  // the instant of the position and velocity
  Geodetic place;
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
  Eigen::Vector3d velocity_enu_m_s = Eigen::Vector3d::Zero();
  double velocity_sd_m_s = 0.0;  // of each axis
};

// Which cues stations are led to: none, those that an operator has allowed, or all that no operator
// has forbidden.
enum class CueAllowance { kNever, kAsk, kAll };

struct CueConfig {
  CueAllowance allow = CueAllowance::kAsk;
  double range_m = 20e3;              // max distance from the nearest station
  double max_age_s = 10.0;            // since its source measured the position
  double most_sd_m = 2000.0;          // a less certain cue is not searched
  double acceleration_sd_m_s2 = 3.0;  // growth of its uncertainty
  int most = 32;                      // at the same time
};

// A cue to which stations are to be led, with its state at one instant.
struct CueAim {
  Cue cue;
  double acceleration_sd_m_s2 = 0.0;

  KinematicState at(std::int64_t utime_us) const;
};

}  // namespace ols::fusion
