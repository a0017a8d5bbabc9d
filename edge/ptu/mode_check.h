// If a ready unit begins to echo or to reply verbosely, this class switches that off without a
// restart. Such a unit may have lost power, and may now be in velocity mode or have other ramps. It
// therefore gets no motion command until its answers show that mode and ramps are right. Pure.
#pragma once

#include <cstdint>

#include "edge/ptu/poll_cycle.h"

namespace ols::ptu {

class ModeCheck {
 public:
  // `pan_acceleration`: the acceleration of pan [counts/s^2] that the unit stated at its start.
  explicit ModeCheck(std::int32_t pan_acceleration) : pan_acceleration_(pan_acceleration) {}

  bool needed() const { return needed_; }
  // To be included in the next cycle while a check is needed.
  static PtuRequest commands();
  static PtuRequest questions();

  // Call begin_cycle() when a cycle is sent, and take() when its replies are complete.
  void begin_cycle() { checking_ = needed_; }
  enum class Result {
    kUnchanged,
    kForgotten,      // the unit has begun to echo or to be verbose
    kRestored,       // mode and ramps are as they were before
    kUnitRestarted,  // several checks have failed, so the unit must be started again
  };
  Result take(const PollCycle& done);

 private:
  std::int32_t pan_acceleration_;
  bool needed_ = false;
  bool checking_ = false;  // a check is part of the cycle that is under way
  int failed_ = 0;
};

}  // namespace ols::ptu
