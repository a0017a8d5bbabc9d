// Converts a PTZ unit's angles and speeds to ONVIF's generic spaces, in which values are from -1 to
// 1. x is positive to the right, y upwards. The positions -1 and 1 are the ends of the travel; the
// velocities -1 and 1 are the greatest speed in each direction. Pure.
#pragma once

#include <array>

#include "sim/onvif/ptz_unit.h"

namespace ols::sim {

using PtzVector = std::array<double, 2>;  // x, y

inline PtzVector generic(const PanTilt& angles, const PtzUnitConfig& unit) {
  const auto share = [](double value, double from, double to) {
    return 2.0 * (value - from) / (to - from) - 1.0;
  };
  return {share(angles.pan_rad, unit.greatest.pan_rad, unit.least.pan_rad),
          share(angles.tilt_rad, unit.least.tilt_rad, unit.greatest.tilt_rad)};
}

// The angle at a generic position along x (`axis` 0) or y (1).
inline double angle_rad(int axis, double value, const PtzUnitConfig& unit) {
  const auto between = [value](double from, double to) {
    return from + 0.5 * (value + 1.0) * (to - from);
  };
  return axis == 0 ? between(unit.greatest.pan_rad, unit.least.pan_rad)
                   : between(unit.least.tilt_rad, unit.greatest.tilt_rad);
}

// The speed [rad/s] of a generic velocity of 1 along x (`axis` 0) or y (1).
inline double full_speed_rad_s(int axis, const PtzUnitConfig& unit) {
  return axis == 0 ? -unit.max_speed_rad_s : unit.max_speed_rad_s;
}

}  // namespace ols::sim
