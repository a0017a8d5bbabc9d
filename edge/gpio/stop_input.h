// The input of the emergency stop. A press counts at once, a release only after it has been stable
// for a while. A line that cannot be read counts as pressed. Pure.
#pragma once

#include <optional>

namespace ols::gpio {

class StopInput {
 public:
  // A release counts after the line has been released for `release_s` without an edge.
  explicit StopInput(double release_s) : release_s_(release_s) {}

  // Takes a level of the line with the time of its edge. Call in order of time.
  void level(bool pressed, double time_s);
  // Notes that the line cannot be read: it counts as pressed until a stable release.
  void lost();

  // Whether the stop counts as pressed. nullopt before the first level, and while the first level
  // is a release that is not stable yet.
  std::optional<bool> pressed(double now_s) const;
  // The time from which pressed() is false if no edge comes until then; nullopt unless the line is
  // released.
  std::optional<double> due_s() const;

 private:
  double release_s_;
  bool was_pressed_ = false;          // true after the first press or loss of the line
  std::optional<double> released_s_;  // time of the release, if no press or loss has followed
};

}  // namespace ols::gpio
