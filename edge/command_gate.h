// Lets a command through once, and only while it is fresh. Pure.
//
// LCM has neither authentication nor protection against replay: a command counts when it comes from
// a newer boot of its sender or with a greater sequence, and when its own stamp is not older than
// its lease by the station's UTC (a margin covers the difference of two clocks). Nothing passes
// twice, whatever the clocks do meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
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
  // What was stamped before `began_utime_us` may have passed a gate of the process before this one:
  // it is taken for replayed.
  CommandGate(const Config& config, std::int64_t began_utime_us)
      : config_(config), began_utime_us_(began_utime_us) {}

  // Nothing when the command may pass; it is then remembered.
  std::optional<GateRefusal> admit(const CommandStamp& stamp, std::int64_t now_utime_us);

 private:
  // Who has been let through: each start of a command line tool is a sender.
  struct Sender {
    std::int64_t boot_id = 0;
    std::int64_t sequence = 0;         // greatest
    std::int64_t utime_us = 0;         // of that one
    std::int64_t latest_utime_us = 0;  // of all
  };
  static constexpr std::size_t kMostSenders = 256;

  bool is_replayed(const CommandStamp& stamp, std::int64_t now_utime_us) const;
  void remember(const CommandStamp& stamp);

  Config config_;
  std::int64_t began_utime_us_;
  std::deque<Sender> senders_;  // in the order of their last command
  // No stamp of a sender that is remembered no more is later.
  std::optional<std::int64_t> forgotten_utime_us_;
};

}  // namespace ols
