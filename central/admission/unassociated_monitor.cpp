#include "central/admission/unassociated_monitor.h"

#include <algorithm>
#include <cmath>

#include "central/measurement/time_span.h"
#include "conditions/alarms.h"

namespace ols::fusion {
namespace {

constexpr double kGap_s = 3.0;  // a longer silence restarts the count

}  // namespace

void UnassociatedMonitor::unexplained(const std::string& station, std::int64_t utime_us) {
  const auto [position, is_new] = stations_.try_emplace(station, Span{utime_us, utime_us});
  Span& span = position->second;
  if (std::abs(seconds(utime_us - span.to_us)) > kGap_s) span = {utime_us, utime_us};
  span.to_us = std::max(span.to_us, utime_us);
}

Alarm UnassociatedMonitor::alarm(const std::string& station, std::int64_t now_us) const {
  const auto found = stations_.find(station);
  if (found == stations_.end()) return {};
  const Span& span = found->second;
  const double for_s = seconds(span.to_us - span.from_us);
  if (for_s < config_.alarm_s || std::abs(seconds(now_us - span.to_us)) > kGap_s) return {};
  return alarm::station_follows_stray(station, for_s);
}

}  // namespace ols::fusion
