// The emergency stop's input. A press counts at once, a release only once it is stable. A line that
// cannot be read counts as pressed. Pure.
#pragma once

#include <optional>

namespace ols::gpio {

class StopInput {
 public:
  // A release counts after the line has been quiet for `release_s`.
  explicit StopInput(double release_s) : release_s_(release_s) {}

  // Takes a level of the line with the time of its edge, in order of time.
  void level(bool pressed, double time_s);
  // Notes that the line cannot be read: it counts as pressed until a stable release.
  void lost();

  // nullopt while unknown: before the first level, and while the first level is a release that is
  // not stable yet.
  std::optional<bool> pressed(double now_s) const;
  // When pressed() will become false if no further edge comes; nullopt if it will not.
  std::optional<double> due_s() const;

 private:
  double release_s_;
  bool was_pressed_ = false;          // it has ever been pressed; a lost line counts as pressed
  std::optional<double> released_s_;  // time since which the line has been released without an edge
};

}  // namespace ols::gpio
