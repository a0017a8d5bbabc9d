// Decides whether a message of the bus may be believed. The message must be signed by a site member
// whose role permits sending it. It must also be meant for this process, be stamped close to this
// host's time, and not be a replay. Cheap checks come first. Therefore a stranger's message costs
// almost nothing, and a member that sends too much is refused before its signatures are verified.
// Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/trust/rate_limit.h"
#include "base/trust/replay_marks.h"
#include "base/trust/station_boots.h"
#include "base/trust/trailer.h"
#include "base/trust/trust_list.h"

namespace ols::trust {

// Why a message is not believed; to_string() is part of its counter's name.
enum class Distrust {
  kUnsigned,
  kStranger,  // the key belongs to no member, or the site tag is wrong
  kRevoked,
  kChannel,    // the member may not send on this channel, or the channel names no enrolled station
  kMalformed,  // signed, but not a valid message
  kOtherBoot,  // a command that names another boot of this station, or no boot
  kStale,      // stamped too far from this host's clock
  kReplayed,
  kRate,  // the member sends more than it may on this kind of channel
  kSignature,
  kCount,  // not a reason: the number of reasons
};
const char* to_string(Distrust reason);

struct Arrival {
  std::int64_t utime_us = 0;  // this host's UTC
  double monotonic_s = 0.0;
};

class Verifier {
 public:
  struct Config {
    std::string station{};     // this process's station, to which commands must name this boot;
                               // empty: the process is not a station
    std::int64_t boot_id = 0;  // of this process
    std::int64_t clock_tolerance_us = 30'000'000;
    // For a process that shows and commands stations, so that it can see and stop a station with a
    // wrong clock. If fresh statuses of the station arrive as well, its stale ones are still
    // refused as a recording (station_boots.h).
    bool takes_stale_statuses = false;
    // Whether an order to a PTU is a stop. Without this function, no order counts as a stop.
    std::function<bool(Bytes)> is_stop{};
  };
  struct Verdict {
    std::optional<Distrust> distrust{};
    std::string sender{};  // the member, if its key is known
    // For a command: whether it names this boot. If not, only a stop may be obeyed.
    bool addressed = false;
    const ChannelRule* rule = nullptr;  // the rule of a message that may be believed
    MessageHead head{};                 // the head of the same message; views into its bytes
  };

  // Without the site's secret, site tags are not checked. This is meant for recordings: tags
  // protect against floods, and nobody floods a recording.
  Verifier(Config config, const std::optional<SiteKey>& site, const TrustList& list);

  // `message`: as received, with its trailer.
  Verdict judge(std::string_view channel, Bytes message, const Arrival& arrival);

  // Replaces the list. Members on both lists keep their marks and rates.
  void adopt(const TrustList& list);
  ReplayMarks& marks() { return marks_; }

 private:
  struct Known {
    Member member;
    std::vector<RateLimit> rates;  // one per rule
    // The limits per station. Key: index of the rule, whether the limit is for stops, station.
    std::map<std::tuple<std::size_t, bool, std::string>, RateLimit> station_rates{};
  };
  struct Judged;

  std::optional<Distrust> judge_origin(Judged& judged);
  std::optional<Distrust> judge_address(Judged& judged) const;
  std::optional<Distrust> judge_time(const Judged& judged) const;
  bool is_fresh(const Judged& judged) const;
  bool is_replayed(const Judged& judged) const;
  void note(const Judged& judged);
  bool stops(const Judged& judged) const;
  std::vector<RateLimit*> rates_of(const Judged& judged) const;
  bool has_tag(const Judged& judged) const;

  Config config_;
  std::optional<SiteKey> site_;
  std::map<KeyId, Known> members_;
  std::map<std::string, bool, std::less<>> stations_;  // enrolled ones
  ReplayMarks marks_;
  StationBoots statuses_;
};

}  // namespace ols::trust
