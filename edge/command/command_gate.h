// Accepts each command once, and only while it is fresh. Pure.
//
// The bus may run without signatures (base/trust/), and LCM has no protection against replayed
// messages. The gate therefore remembers each command by its sender's boot id, its sequence number
// and its stamp, for longer than the command can stay fresh. A command is fresh as long as its
// stamp, by the station's UTC, is not older than its lease plus a margin for the difference between
// the two clocks. Sequence numbers are never compared, and the stamps of one sender never block
// another: without signatures, anybody may use any name. If the station's clock is set back by more
// than a lease, or after a restart, forgotten commands may pass again.
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
    double clock_margin_s = 0.5;  // largest difference between the two clocks
    double lease_max_s = 10.0;
    // This number of commands is always remembered, however old they are, because they would become
    // fresh again if the clock were set back. It corresponds to four minutes of slews.
    std::size_t kept = 4096;
    // Largest number of remembered commands. Forged commands with the latest stamp can block others
    // only if more than this number arrive within the margin. That would be 130 000 a second, more
    // than a station can read.
    std::size_t most = 65536;
  };
  // Commands stamped before `began_utime_us` are refused as replayed: the previous process may have
  // accepted them.
  CommandGate(const Config& config, std::int64_t began_utime_us)
      : config_(config), began_utime_us_(began_utime_us) {}

  // Returns nullopt if the command may pass; it is then remembered.
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
      std::numeric_limits<std::int64_t>::min();  // the time at the last call
  std::set<Passed> passed_;
  // The latest stamp among the forgotten commands.
  std::optional<std::int64_t> forgotten_utime_us_;
};

}  // namespace ols::station
