// Accepts each command once, and only while the command is fresh. Pure.
//
// LCM does not protect against replayed messages, and the bus may run without signatures
// (base/trust/). Therefore, the gate remembers each command: its sender's boot id, its sequence
// number and its time stamp. It does so for longer than the command is fresh. A command is fresh
// while the age of its stamp, by the station's UTC, is at most its lease plus a margin for the
// difference between the two clocks. The gate does not require that sequence numbers or stamps
// increase. If it did, anybody could block a sender on an unsigned bus, by sending a higher number
// under its boot id. If the station's clock is set back by more than the longest lease, commands
// that the gate has forgotten may pass again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <tuple>

namespace ols::station {

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
    double clock_margin_s = 0.5;  // maximum difference between the two clocks
    double lease_max_s = 10.0;
    // Number of commands that are always remembered: the newest ones, however old they are. They
    // would become fresh again if the clock were set back. A station receives about this number of
    // slews in four minutes.
    std::size_t kept = 4096;
    // Maximum number of remembered commands. If there are more, the gate forgets commands that are
    // still fresh. It then refuses all commands whose stamps are not later than those of the
    // forgotten ones. To block other senders in this way, a forger would need 130 000 commands a
    // second, which is more than a station can read.
    std::size_t most = 65536;
  };
  // `began_utime_us`: when this process began. Commands with earlier stamps are refused as
  // replayed, because the previous process may have accepted them.
  CommandGate(const Config& config, std::int64_t began_utime_us)
      : config_(config), began_utime_us_(began_utime_us) {}

  // Returns nullopt, and remembers the command, if it may pass.
  std::optional<GateRefusal> admit(const CommandStamp& stamp, std::int64_t now_utime_us);

  std::size_t remembered() const { return passed_.size(); }

 private:
  // Stamp [us], boot id and sequence, oldest first.
  using Passed = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

  void look_at_clock(std::int64_t now_utime_us);
  bool is_replayed(const CommandStamp& stamp, std::int64_t now_utime_us) const;
  void remember(const CommandStamp& stamp, std::int64_t now_utime_us);

  Config config_;
  std::int64_t began_utime_us_;
  std::int64_t latest_utime_us_ =
      std::numeric_limits<std::int64_t>::min();  // time of the last call
  std::set<Passed> passed_;
  // The latest stamp of the commands that were forgotten.
  std::optional<std::int64_t> forgotten_utime_us_;
};

}  // namespace ols::station
