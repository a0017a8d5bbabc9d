// Where a station has to point so as to have the target in view.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "central/ray.h"
#include "geometry/direction.h"

namespace ols {

struct SlewConfig {
  double rate_hz = 10.0;
  double lead_s = 0.15;               // from "now" to the instant that a station can act on
  double lease_s = 0.5;               // without a newer command the station halts
  double coast_s = 2.0;               // a target is predicted for so long after its last position
  double acceleration_sd_m_s2 = 5.0;  // how the prediction spreads
};

struct Slew {
  std::string station;
  std::int64_t utime_us = 0;         // message time at which it was made
  std::int64_t effect_utime_us = 0;  // the instant at which the direction holds
  std::int64_t target_id = 0;
  AzimuthElevation direction;  // in the horizon at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
  double lease_s = 0.0;
};

// Predicts a target located at epoch_us to now + lead and gives its direction from a camera centre.
// station and target_id are left to the caller.
Slew plan_slew(const Estimate& target, std::int64_t epoch_us, std::int64_t now_us,
               const Eigen::Vector3d& camera_ecef, const SlewConfig& config);

}  // namespace ols
