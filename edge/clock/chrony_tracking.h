// Parses the output of `chronyc -c tracking`. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ols::clock {

struct ChronyTracking {
  // Name or address of the time source: "PPS", "192.168.1.1"; empty if there is none yet.
  std::string reference;
  bool synchronised = false;
  double measured_utc_s = 0.0;  // UTC of the last measurement ("Ref time")
  double offset_s = 0.0;        // system clock minus NTP time; > 0 if the system clock is fast
  double root_delay_s = 0.0, root_dispersion_s = 0.0;
  int leap_s = 0;  // announced leap second: +1 inserted, -1 deleted

  // 1-sigma of the system clock. chrony's manual states the bound |offset| + root dispersion + root
  // delay / 2. The error is taken as uniformly distributed within this bound.
  double error_s() const;
};

// nullopt if the line has another form. If chronyd does not run, the line is "506 Cannot talk to
// daemon".
std::optional<ChronyTracking> parse_chrony_tracking(std::string_view line);

}  // namespace ols::clock
