// The emergency stop's input: a press counts at once, a release only when it has been stable, and a
// line that cannot be read counts as pressed. Pure.
#pragma once

#include <optional>

namespace ols::gpio {

class StopInput {
 public:
  // A release counts when the line has been quiet for `release_s`.
  explicit StopInput(double release_s) : release_s_(release_s) {}

  // A level of the line with the time of the edge. In time order.
  void level(bool pressed, double time_s);
  // The line cannot be read: pressed, until a stable release is seen.
  void lost();

  // Nothing while unknown: before the first level, and while the first level is a release that has
  // not been stable yet.
  std::optional<bool> pressed(double now_s) const;
  // When pressed() becomes false without another edge; nothing if it does not.
  std::optional<double> due_s() const;

 private:
  double release_s_;
  bool was_pressed_ = false;          // ever, or lost
  std::optional<double> released_s_;  // since when the line has been quietly released
};

}  // namespace ols::gpio
