// What a mount's position reports are worth, by the camera's own pictures. Pure.
//
//   seen = zero + gain * reported + backlash * approach / 2 + gain * delay * rate
//
// approach: 1 or -1, the sign of the last motion. A report that is `delay` late shows where the
// mount was, so that in motion the picture is ahead of it.
#pragma once

#include <optional>
#include <vector>

namespace ols::calibration {

// One axis at one picture.
struct MountReading {
  double reported_rad = 0.0, rate_rad_s = 0.0;  // at the exposure, as reported
  int approach = 0;                             // 0: unknown
  double seen_rad = 0.0;                        // by the picture
  bool moves = false;
};

struct Measured {
  double value = 0.0, sd = 0.0;  // 1-sigma
};

struct MountFit {
  Measured gain;                 // -1: it counts the other way
  Measured backlash_rad;         // 0 with sd 0: it was approached from one side only
  Measured delay_s;              // later than the station takes it to be
  double position_sd_rad = 0.0;  // of a reported position at rest, beside the picture
  int rests = 0, moves = 0;      // pictures that agree
};

// nullopt: too few pictures at rest or in motion, no motion both ways, or a result that is worth
// nothing.
std::optional<MountFit> fit_mount(std::vector<MountReading> readings);

}  // namespace ols::calibration
