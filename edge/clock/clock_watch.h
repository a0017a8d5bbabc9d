// How good the station's UTC is. Pure: kernel and chrony are read by edge/clock/clock_source.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols {

enum class ClockState { kUnknown, kSynchronised, kUnsynchronised };

// What the kernel (ntp_adjtime) and chrony say at one moment.
struct ClockReading {
  double monotonic_s = 0.0;
  std::int64_t utime_us = 0;  // the same instant by CLOCK_REALTIME
  bool service = false;       // a time service disciplines the clock, or did in this boot
  bool synchronised = false;
  std::optional<double> estimated_error_s;  // 1-sigma as the service has it
  std::optional<double> offset_s;           // chrony: system clock minus NTP time
  std::string source;                       // "chrony: PPS", "kernel"; empty: none
};

struct ClockQuality {
  ClockState state = ClockState::kUnknown;
  double error_s = 0.0;     // 1-sigma of UTC
  std::uint64_t steps = 0;  // of CLOCK_REALTIME against CLOCK_MONOTONIC
  double last_step_s = 0.0;
  std::string text;  // in words
};

class ClockWatch {
 public:
  struct Config {
    double assumed_sd_s = 1e-3;  // of a clock of unknown quality
    double step_s = 0.05;        // a jump of more between two calls is a step
    double slew_per_s = 1e-3;    // the service may steer this much: not a step
    double distrust_s = 60.0;    // after a step without a service that confirms the new time
    double drift_per_s = 2e-5;   // of a free-running clock: the error grows
  };
  explicit ClockWatch(const Config& config) : config_(config) {}

  // Often (each turn of the control loop): both clocks, so that no frame is stamped across a step.
  void tick(double monotonic_s, std::int64_t utime_us);
  // Now and then: what the time service says.
  void add(const ClockReading& reading);

  ClockQuality quality(double monotonic_s) const;

 private:
  Config config_;
  std::optional<double> offset_s_;  // UTC minus monotonic at the last tick
  double tick_s_ = 0.0;
  std::optional<ClockReading> reading_;
  std::optional<double> stepped_s_;
  double last_step_s_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace ols
