#include "central/app/fusion_conflict_monitor.h"

#include <utility>

#include "conditions/alarms.h"

namespace ols::fusion {
namespace {

constexpr double kSilent_s = 5.0;  // some statuses may be lost

}  // namespace

bool FusionConflictMonitor::hear(std::int64_t boot_id, double now_s) {
  if (boot_id == own_boot_id_) return false;
  news_ = news_ || now_s - heard_s_ > kSilent_s;
  heard_s_ = now_s;
  return true;
}

Alarm FusionConflictMonitor::alarm(double now_s) const {
  if (now_s - heard_s_ > kSilent_s) return {};
  return alarm::another_fusion();
}

bool FusionConflictMonitor::take_event() { return std::exchange(news_, false); }

}  // namespace ols::fusion
