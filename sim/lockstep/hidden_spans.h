// How a site gets on with a target that the land hides from its stations, in simulated time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/lockstep/lockstep.h"

namespace ols::sim {

// What was predicted of an exit, against the truth. NEES: the squared error over the stated
// variance, per dimension.
struct JudgedExit {
  double ahead_s = 0.0;  // from the prediction to the true exit
  double error_s = 0.0, sd_s = 0.0;
  double place_nees = 0.0;  // of two dimensions
  double error_rad = 0.0;
  double time_nees() const { return error_s * error_s / (sd_s * sd_s); }
};

// A time for which the land hid the target from one station.
struct HiddenSpan {
  std::string station;
  double from_s = 0.0, to_s = 0.0;
  bool predicted = false;  // the station had been told so in the middle of it
  // Of the frames in it, once the station's coasting time was over.
  int frames = 0, lost = 0, slewed = 0, hidden = 0;
  std::optional<double> found_s;  // after its end: the station tracks again
  // As predicted when it had just begun, and shortly before its end.
  std::optional<JudgedExit> first, last;
};

// The spans of at least 1.2 s in which the stations of a finished run were at work.
std::vector<HiddenSpan> hidden_spans(const World& world, const LockstepResult& result);

}  // namespace ols::sim
