// The button that re-arms a station after an emergency stop. It must first be seen open, and then
// be held for a while. Thus a stuck button, a broken wire or a short touch does not re-arm the
// station. Pure.
#pragma once

#include <optional>

namespace ols::gpio {

class RearmInput {
 public:
  explicit RearmInput(double hold_s) : hold_s_(hold_s) {}

  // Takes a level of the line with the time of its edge. Call in order of time.
  void level(bool closed, double time_s);
  // Notes that the line cannot be read, or that the emergency stop has changed. The button must
  // then be seen open and be held again.
  void interrupted();
  // Returns true if the button has been held long enough, but only once for each press.
  bool take(double now_s);
  // The time from which take() returns true if no edge comes until then; nullopt if the button is
  // not held.
  std::optional<double> due_s() const;

 private:
  double hold_s_;
  // Seen open since the start, the last interruption, or the last re-arming.
  bool seen_open_ = false;
  std::optional<double> closed_s_;  // time since which the button is held
};

}  // namespace ols::gpio
