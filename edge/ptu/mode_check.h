// Switches echo and verbose replies off if a ready unit begins to use them, without a new start
// sequence. The unit may have lost power: it may be in velocity mode, or have other accelerations.
// It therefore gets no motion command until its answers show the right mode and acceleration. Pure.
#pragma once

#include <cstdint>

#include "edge/ptu/poll_cycle.h"

namespace ols::ptu {

class ModeCheck {
 public:
  // `pan_acceleration` [counts/s^2]: as the unit stated it in the start sequence.
  explicit ModeCheck(std::int32_t pan_acceleration) : pan_acceleration_(pan_acceleration) {}

  bool needed() const { return needed_; }
  // The commands and questions to include in the next poll cycle while a check is needed.
  static PtuRequest commands();
  static PtuRequest questions();

  // Call begin_cycle() when a cycle is sent, and take() when its replies are complete.
  void begin_cycle() { checking_ = needed_; }
  enum class Result {
    kUnchanged,
    kForgotten,      // the unit has begun to echo or to reply verbosely
    kRestored,       // mode and acceleration are right again
    kUnitRestarted,  // five checks have failed; the unit must be started again
  };
  Result take(const PollCycle& done);

 private:
  std::int32_t pan_acceleration_;
  bool needed_ = false;
  bool checking_ = false;  // the current cycle contains a check
  int failed_ = 0;
};

}  // namespace ols::ptu
