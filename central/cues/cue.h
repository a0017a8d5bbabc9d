// A target that others know of. Stations may be led to it; it never touches a position of ours.
// Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "central/filter/interacting_models.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

struct Cue {
  std::string id, label;
  std::int64_t utime_us = 0;  // when its message was made
  std::int64_t state_us = 0;  // the instant at which what follows holds
  Geodetic place;
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
  Eigen::Vector3d velocity_enu_m_s = Eigen::Vector3d::Zero();
  double velocity_sd_m_s = 0.0;  // of each axis
};

// Whether stations are led to cues: never, to those that an operator allows, to all not forbidden.
enum class CueAllowance { kNever, kAsk, kAll };

struct CueConfig {
  CueAllowance allow = CueAllowance::kAsk;
  double range_m = 20e3;              // of the nearest station: the site's area
  double max_age_s = 10.0;            // since its source knew its place
  double most_sd_m = 2000.0;          // what is less certain is no place to look at
  double acceleration_sd_m_s2 = 3.0;  // how fast it becomes less certain
  int most = 32;                      // at the same time
};

// A cue to which stations are to be led, and where it is at an instant.
struct CueAim {
  Cue cue;
  double acceleration_sd_m_s2 = 0.0;

  KinematicState at(std::int64_t utime_us) const;
};

}  // namespace ols::fusion
