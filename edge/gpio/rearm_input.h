// The button that re-arms a station after an emergency stop: it must be seen open, and then be held
// for a while, so that neither a stuck button nor a broken wire nor a passing touch does it. Pure.
#pragma once

#include <optional>

namespace ols::gpio {

class RearmInput {
 public:
  explicit RearmInput(double hold_s) : hold_s_(hold_s) {}

  // A level of the line with the time of the edge. In time order.
  void level(bool closed, double time_s);
  // The line cannot be read, or the stop was pressed: the time held so far does not count.
  void interrupted();
  // True once each time that it was held long enough.
  bool take(double now_s);
  // When take() becomes true without another edge; nothing if it does not.
  std::optional<double> due_s() const;

 private:
  double hold_s_;
  bool seen_open_ = false;  // since the start, an interruption, or the last time it was held
  std::optional<double> closed_s_;  // since when it is held
};

}  // namespace ols::gpio
