// Whether what the fusion makes is of the present, by its host's clock. The fusion itself knows no
// time but that of the messages: after a standstill (a closed lid, a stopped process) it works off
// what has waited for it, and would tell targets of long ago as if they were new. Pure.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace ols::fusion {

class TimelinessGate {
 public:
  // tolerance_s: how far from the host's clock the messages' time may be.
  explicit TimelinessGate(double tolerance_s) : tolerance_s_(tolerance_s) {}

  // What is made for this instant may go out. host_us: UTC by the host; now_s: its monotonic clock.
  bool passes(std::int64_t utime_us, std::int64_t host_us, double now_s);
  // In words, while something was withheld within the last seconds; empty otherwise.
  std::string alarm(double now_s) const;
  // Once at the beginning of such a time.
  bool take_event();

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  double tolerance_s_;
  double withheld_s_ = kNever;  // when something was, last
  double off_s_ = 0.0;          // of that, from the host's clock
  bool news_ = false;
};

}  // namespace ols::fusion
