// Finds by how much the times of a camera's pictures are late, from the brightness of a light that
// GNSS time switches: an LED at the time pulse of a receiver. Pure.
//
// A picture collects light during its exposure; what it shows of the light is the share of the
// exposure in which the light is on. The delay, the length of the exposure and both brightnesses
// are estimated together. If the period is a multiple of the interval between pictures, all
// pictures fall on the same few phases of the light, and the delay is known only to a part of that
// interval; the uncertainty says so.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/measured.h"

namespace ols::calibration {

// The light is on during the first `lit_s` of each period; periods begin at UTC 0.
struct BlinkingLight {
  double period_s = 1.0;
  double lit_s = 0.1;  // less than the period
};

struct LightSample {
  double time_s = 0.0;  // UTC of mid-exposure, as stamped
  double brightness = 0.0;
};

struct LightFit {
  // By how much the times are late; negative: they are early. Whole periods cannot be seen: the
  // value is within half a period of zero. nullopt if the brightness does not follow the light, or
  // if several delays explain it.
  std::optional<Measured> late_s;
  // How many of its sigmas the light is brighter than the darkness.
  double contrast = 0.0;
};

// Samples of a minute or more, in any order. Throws std::invalid_argument if the light is not
// possible (period_s <= 0, lit_s outside of 0..period_s), or if there are fewer than 50 samples.
LightFit fit_light(const std::vector<LightSample>& samples, const BlinkingLight& light);

}  // namespace ols::calibration
