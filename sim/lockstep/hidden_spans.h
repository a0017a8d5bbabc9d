// Measures, in simulated time, how well a site predicts that the land hides a target from a
// station, and how soon the station then finds the target again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/lockstep/lockstep.h"

namespace ols::sim {

// The error of a predicted exit. The exit is the instant and the direction in which the target
// emerges from behind the land. NEES: the squared error over the stated variance, per dimension.
struct JudgedExit {
  double ahead_s = 0.0;  // from the prediction to the true exit
  double error_s = 0.0, sd_s = 0.0;
  double place_nees = 0.0;  // of the direction, mean of its two dimensions
  double error_rad = 0.0;
  double time_nees() const { return error_s * error_s / (sd_s * sd_s); }
};

// A period in which the land hid the target from one station.
struct HiddenSpan {
  std::string station;
  double from_s = 0.0, to_s = 0.0;
  bool predicted = false;  // at the middle of the span, a valid occlusion notice predicted it
  // Number of the span's frames after the station's coasting time, and number of those frames in
  // which the station was in each of three states.
  int frames = 0, lost = 0, slewed = 0, hidden = 0;
  std::optional<double> found_s;  // time from the end of the span until the station tracks again
  // The exit as predicted just after the beginning of the span, and shortly before its end.
  std::optional<JudgedExit> first, last;
};

// Returns the spans of at least 1.2 s in a finished run. Spans that began before all stations had a
// designation, or that lasted until the last frame, are left out.
std::vector<HiddenSpan> hidden_spans(const World& world, const LockstepResult& result);

}  // namespace ols::sim
