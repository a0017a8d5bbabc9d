// The button that re-arms a station after an emergency stop. It must be seen open and then be held
// for a while, so that a stuck button, a broken wire or a brief touch does not re-arm the station.
// Pure.
#pragma once

#include <optional>

namespace ols::gpio {

class RearmInput {
 public:
  explicit RearmInput(double hold_s) : hold_s_(hold_s) {}

  // Takes a level of the line with the time of its edge, in order of time.
  void level(bool closed, double time_s);
  // Notes that the line cannot be read, or that the stop was pressed: the time held so far does not
  // count.
  void interrupted();
  // True once each time the button has been held long enough.
  bool take(double now_s);
  // When take() will become true if no further edge comes; nullopt if it will not.
  std::optional<double> due_s() const;

 private:
  double hold_s_;
  bool seen_open_ = false;          // since the start, an interruption, or the last re-arming
  std::optional<double> closed_s_;  // time since which the button is held
};

}  // namespace ols::gpio
