#include "edge/ptu/mode_check.h"

#include <utility>

#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

namespace {

constexpr int kMaxChecks = 5;  // before the unit is started again

}  // namespace

PtuRequest ModeCheck::commands() { return PtuRequest().plain("ED").plain("FT"); }

PtuRequest ModeCheck::questions() {
  return PtuRequest().plain("C").query(PtuAxis::kPan, PtuQuantity::kAcceleration);
}

ModeCheck::Result ModeCheck::take(const PollCycle& done) {
  if (!checking_) {
    if (!done.modes_forgotten()) return Result::kUnchanged;
    return std::exchange(needed_, true) ? Result::kUnchanged : Result::kForgotten;
  }
  const auto& answers = done.answers();
  const bool restored = !done.modes_forgotten() && answers.size() == 2 &&
                        says_independent(answers[0]) && answers[1].ok &&
                        answers[1].count() == pan_acceleration_;
  if (restored) {
    needed_ = false;
    failed_ = 0;
    return Result::kRestored;
  }
  return ++failed_ >= kMaxChecks ? Result::kUnitRestarted : Result::kUnchanged;
}

}  // namespace ols::ptu
