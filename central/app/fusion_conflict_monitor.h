// Detects another fusion on the same bus. Two fusions would send conflicting slews. Pure.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "conditions/alarm.h"

namespace ols::fusion {

class FusionConflictMonitor {
 public:
  explicit FusionConflictMonitor(std::int64_t own_boot_id) : own_boot_id_(own_boot_id) {}

  // Takes a fusion status, possibly our own. now_s: the host's monotonic clock. Returns true if it
  // is from another fusion.
  bool hear(std::int64_t boot_id, double now_s);
  // The alarm, if another fusion has sent a status within the last few seconds; otherwise empty.
  Alarm alarm(double now_s) const;
  // True once, after the first status of another fusion.
  bool take_event();

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::int64_t own_boot_id_;
  double heard_s_ = kNever;
  bool news_ = false;
};

}  // namespace ols::fusion
