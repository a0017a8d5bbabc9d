// Decides whether the fusion's output is current by the host's clock. The fusion itself knows only
// message time. After a suspension (a closed lid, a stopped process), or if the fusion is too slow,
// it processes messages that have waited. Without this gate it would publish old targets as if they
// were new. Pure.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "conditions/alarm.h"

namespace ols::fusion {

class TimelinessGate {
 public:
  // tolerance_s: largest difference between message time and the host's clock.
  explicit TimelinessGate(double tolerance_s) : tolerance_s_(tolerance_s) {}

  // Whether output for this epoch may be sent. host_us: the host's UTC. now_s: the host's monotonic
  // clock. waited_s: how long the message that caused the output waited from its arrival to its
  // processing.
  bool passes(std::int64_t utime_us, std::int64_t host_us, double now_s, double waited_s);
  // The alarm while output was withheld within the last seconds; otherwise empty.
  Alarm alarm(double now_s) const;
  // True once, when output is first withheld.
  bool take_event();

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  double tolerance_s_;
  double withheld_s_ = kNever;  // when output was last withheld
  double off_s_ = 0.0;          // the epoch of that output minus the host's clock
  double waited_s_ = 0.0;       // how long the message that caused it had waited
  bool news_ = false;
};

}  // namespace ols::fusion
