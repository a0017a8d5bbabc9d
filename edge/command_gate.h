// Lets a command through once, and only while it is fresh. Pure.
//
// LCM has neither authentication nor protection against replay: a command counts when it comes from
// a newer boot of its sender or with a greater sequence, and when its own stamp is not older than
// its lease by the station's UTC (a margin covers the difference of two clocks).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols {

struct CommandStamp {
  std::int64_t utime_us = 0;
  std::int64_t boot_id = 0;
  std::int64_t sequence = 0;
  double lease_s = 0.0;
};

enum class GateRefusal { kStale, kFuture, kReplayed, kLease };
const char* to_string(GateRefusal refusal);

class CommandGate {
 public:
  struct Config {
    double clock_margin_s = 0.5;  // two clocks may differ by this much
    double lease_max_s = 10.0;
  };
  explicit CommandGate(const Config& config) : config_(config) {}

  // Nothing when the command may pass; it is then remembered.
  std::optional<GateRefusal> admit(const CommandStamp& stamp, std::int64_t now_utime_us);

 private:
  Config config_;
  std::optional<CommandStamp> last_;
};

}  // namespace ols
