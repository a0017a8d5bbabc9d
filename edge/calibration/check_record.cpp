#include "edge/calibration/check_record.h"

#include "conditions/alarms.h"

namespace ols::station {

void CheckRecord::note(double now_s) {
  now_s_ = now_s;
  if (!judged_s_) judged_s_ = now_s;
}

void CheckRecord::note_judged() {
  judged_s_ = now_s_;
  reason_ = "it was never idle long enough";
}

void CheckRecord::note_late(int rounds) {
  late_ = rounds;
  if (rounds > 0) reason_ = "the unit does not come to its reference views";
}

Alarm CheckRecord::alarm() const {
  constexpr int kRounds = 3;
  constexpr double kDay_s = 86400.0, kHour_s = 3600.0;
  if (too_few_) return alarm::views_too_few();
  const double since_s = judged_s_ ? now_s_ - *judged_s_ : 0.0;
  if (since_s < kDay_s && late_ < kRounds) return {};
  return alarm::calibration_not_checked(since_s / kHour_s, reason_);
}

}  // namespace ols::station
