#include "edge/command/slew_conflict_monitor.h"

#include <utility>

namespace ols::station {
namespace {

constexpr double kLately_s = 5.0;

}  // namespace

void SlewConflictMonitor::note(std::int64_t boot_id, double now_s) {
  if (newest_.boot_id != boot_id) {
    const bool is_back = former_.boot_id == boot_id && now_s - former_.heard_s < kLately_s;
    if (is_back) several_s_ = now_s;
    former_ = std::exchange(newest_, Sender{boot_id, now_s});
  }
  newest_.heard_s = now_s;
}

bool SlewConflictMonitor::are_several(double now_s) const { return now_s - several_s_ < kLately_s; }

}  // namespace ols::station
