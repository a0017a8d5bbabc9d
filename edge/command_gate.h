// Lets a command through once, and only while it is fresh. Pure.
//
// LCM has neither authentication nor protection against replay. A command counts once: its sender's
// boot id, its sequence and its stamp are remembered for longer than it can be fresh. It is fresh
// when its own stamp is not older than its lease by the station's UTC (a margin covers the
// difference of two clocks). Sequences are never compared, and no sender's stamps bar another's:
// who cannot tell senders apart must not let one speak for the others. Nothing passes twice that is
// remembered; when the station's clock is set back by more than a lease, what is forgotten may, as
// after a restart.
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
    double clock_margin_s = 0.5;  // two clocks may differ by this much
    double lease_max_s = 10.0;
    // So many are remembered in any case, however old: a clock that is set back makes them fresh
    // again. Four minutes of slews.
    std::size_t kept = 4096;
    // So many at most. Forged commands of the latest stamp bar others only when more of them than
    // this come within the margin: 130 000 a second, which no station can read.
    std::size_t most = 65536;
  };
  // What was stamped before `began_utime_us` may have passed a gate of the process before this one:
  // it is taken for replayed.
  CommandGate(const Config& config, std::int64_t began_utime_us)
      : config_(config), began_utime_us_(began_utime_us) {}

  // Nothing when the command may pass; it is then remembered.
  std::optional<GateRefusal> admit(const CommandStamp& stamp, std::int64_t now_utime_us);

  std::size_t remembered() const { return passed_.size(); }

 private:
  // Stamp [us], boot id and sequence: the oldest first.
  using Passed = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

  void look_at_clock(std::int64_t now_utime_us);
  bool is_replayed(const CommandStamp& stamp, std::int64_t now_utime_us) const;
  void remember(const CommandStamp& stamp, std::int64_t now_utime_us);

  Config config_;
  std::int64_t began_utime_us_;
  std::int64_t latest_utime_us_ =
      std::numeric_limits<std::int64_t>::min();  // "now" of the last one
  std::set<Passed> passed_;
  // No stamp of a command that passed and is remembered no more is later.
  std::optional<std::int64_t> forgotten_utime_us_;
};

}  // namespace ols::station
