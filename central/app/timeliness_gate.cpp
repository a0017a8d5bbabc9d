#include "central/app/timeliness_gate.h"

#include <cmath>
#include <utility>

#include "conditions/alarms.h"

namespace ols::fusion {
namespace {

constexpr double kTold_s = 3.0;  // so that one or two statuses report even a short one
constexpr double kLoad = 0.5;    // overload: the wait is more than this share of the offset

}  // namespace

bool TimelinessGate::passes(std::int64_t utime_us, std::int64_t host_us, double now_s,
                            double waited_s) {
  // In floating point: the difference from an absurd stamp must not overflow.
  const double off_s = (static_cast<double>(utime_us) - static_cast<double>(host_us)) * 1e-6;
  if (std::abs(off_s) <= tolerance_s_) return true;
  news_ = news_ || now_s - withheld_s_ > kTold_s;
  withheld_s_ = now_s;
  off_s_ = off_s;
  waited_s_ = waited_s;
  return false;
}

Alarm TimelinessGate::alarm(double now_s) const {
  if (now_s - withheld_s_ > kTold_s) return {};
  if (waited_s_ > kLoad * std::abs(off_s_)) return alarm::withheld_overload(waited_s_);
  return alarm::withheld_time(off_s_);
}

bool TimelinessGate::take_event() { return std::exchange(news_, false); }

}  // namespace ols::fusion
