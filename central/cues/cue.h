// A cue: a target reported from outside the site. Stations may be led to a cue, but a cue never
// changes a position that the fusion computes. Pure.
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
  std::int64_t state_us = 0;  // the instant of position and velocity
  Geodetic place;
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
  Eigen::Vector3d velocity_enu_m_s = Eigen::Vector3d::Zero();
  double velocity_sd_m_s = 0.0;  // 1-sigma of each axis
};

// Which cues lead stations: none, those that an operator has allowed, or all that no operator has
// forbidden.
enum class CueAllowance { kNever, kAsk, kAll };

struct CueConfig {
  CueAllowance allow = CueAllowance::kAsk;
  double range_m = 20e3;      // largest distance from the nearest station
  double max_age_s = 10.0;    // largest time since the source measured the position
  double most_sd_m = 2000.0;  // cues with a larger horizontal or vertical 1-sigma are refused
  // 1-sigma of the assumed acceleration. It determines how fast the uncertainty grows.
  double acceleration_sd_m_s2 = 3.0;
  int most = 32;  // largest number of cues at the same time
};

// A cue to which stations are to be led, with its state at one instant.
struct CueAim {
  Cue cue;
  double acceleration_sd_m_s2 = 0.0;

  KinematicState at(std::int64_t utime_us) const;
};

}  // namespace ols::fusion
