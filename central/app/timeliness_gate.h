// Whether the fusion's output is current by the host's clock. The fusion has no time but that of
// the messages: after a suspension (a closed lid, a stopped process) it processes the queued
// messages and would publish old targets as if they were new. The same where it cannot keep up: its
// output is as old as the messages have waited. Pure.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace ols::fusion {

class TimelinessGate {
 public:
  // tolerance_s: max difference of message time from the host's clock.
  explicit TimelinessGate(double tolerance_s) : tolerance_s_(tolerance_s) {}

  // Whether output for this epoch may be sent. host_us: the host's UTC; now_s: its monotonic clock;
  // waited_s: from the arrival of the message that caused the output to its processing.
  bool passes(std::int64_t utime_us, std::int64_t host_us, double now_s, double waited_s);
  // The alarm, while output was withheld within the last seconds; empty otherwise.
  std::string alarm(double now_s) const;
  // True once, when such a time begins.
  bool take_event();

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  double tolerance_s_;
  double withheld_s_ = kNever;  // when output was last withheld
  double off_s_ = 0.0;          // its offset from the host's clock
  double waited_s_ = 0.0;       // and how long its message had waited
  bool news_ = false;
};

}  // namespace ols::fusion
