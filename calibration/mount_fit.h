// Measures the errors of the positions that a mount reports, by comparing them with the camera's
// pictures. Pure.
//
//   at rest:   seen = zero + gain * reported + backlash * approach / 2
//   in motion: seen = zero' + gain * reported + backlash * approach / 2 + gain * delay * rate
//
// seen: the angle of an axis according to the picture. reported, rate: the angle and the rate that
// the mount reports. approach: 1 or -1, the sign of the last motion. A report that is late by
// `delay` states an earlier position of the mount. In motion, the picture is therefore ahead of the
// report.
//
// Motion has a zero of its own, because a move to a position misses it by an error that stays until
// the next such move. All motion has about the same speed, at which backlash and delay look the
// same. Backlash is therefore measured at rest alone, and its uncertainty is part of the delay's.
#pragma once

#include <optional>
#include <vector>

#include "calibration/measured.h"

namespace ols::calibration {

// One axis at one picture.
struct MountReading {
  double reported_rad = 0.0, rate_rad_s = 0.0;  // at the exposure, as reported
  int approach = 0;                             // 0: unknown
  double seen_rad = 0.0;                        // according to the picture
  bool moves = false;
};

struct MountFit {
  Measured gain;                 // near 1; near -1: the reported angles have the wrong sign
  Measured backlash_rad;         // 0 with sd 0: all positions were approached from one side
  Measured delay_s;              // in addition to the delay that the station assumes
  double position_sd_rad = 0.0;  // 1-sigma of a position reported at rest, as pictures show it
  int rests = 0, moves = 0;      // numbers of pictures, at rest and in motion, that fit
};

// nullopt if there are too few pictures at rest or in motion, if the mount has not moved in both
// directions, or if the result is too uncertain.
std::optional<MountFit> fit_mount(std::vector<MountReading> readings);

// Whether the delays of a mount's axes differ by more than 3 sigma plus 20 ms. Both axes of a mount
// have the same delay, because the mount reports them together. If the measured delays differ, the
// pictures of one axis came with wrong times.
bool have_different_delays(const MountFit& a, const MountFit& b);

}  // namespace ols::calibration
