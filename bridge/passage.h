// Decides which messages pass between a bus and the network of sites. Messages pass unchanged.
// Pure.
//
// The bridge has no keys: where messages are signed, the receiver verifies the signatures. The
// rules of Passage say which messages may go where, how large and how frequent they may be, and how
// old a command may be.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/trust/message_head.h"
#include "bridge/channel_rate_limits.h"
#include "bridge/epoch_fence.h"
#include "bridge/sequence_watch.h"
#include "bridge/station_places.h"
#include "bridge/subject.h"

namespace ols::bridge {

using Bytes = std::span<const std::uint8_t>;
using Headers = std::map<std::string, std::string>;

inline constexpr const char* kIdHeader = "Nats-Msg-Id";  // a stream stores each id only once
inline constexpr const char* kTargetHeader = "Ols-Target";
inline constexpr const char* kEpochHeader = "Ols-Epoch";
inline constexpr const char* kUnconfirmedHeader = "Ols-Unconfirmed";
inline constexpr const char* kOwnerHeader = "Ols-Owner";

enum class Role {
  kSite,    // sends its stations' messages, takes commands for them
  kRegion,  // takes stations' messages for its fusion, sends the fusion's targets and commands
};

// Why a message does not pass.
enum class Refusal {
  kShape,  // messages of this channel or subject never pass, or not in this direction
  kSize,
  kMalformed,  // the message does not begin as its kind does, or its headers are impossible
  kName,       // the station is not one of the site's, its name belongs to another place, or the
               // message names another station
  kRate,
  kStale,   // too old by this host's clock; a command also if it is from the future
  kOwn,     // the message came in over the bridge, so it must not go out again
  kEpoch,   // a command from an owner that was replaced
  kNobody,  // a command to a station from which nothing was received
  kNotOwned,
  kCount,  // not a reason: the number of reasons
};
const char* to_string(Refusal reason);

struct PassageConfig {
  Role role = Role::kSite;
  std::string region = "region", site = "site";
  std::vector<std::string> stations{};  // stations of the site whose messages go out; empty: all
  std::vector<Selection> takes{};       // stations of other sites whose messages come in
  std::vector<std::string> commands{};  // commands that may pass
  bool targets = false;                 // whether targets of the fusion on this bus go out
  double command_age_s = 1.0, live_age_s = 5.0;
};

struct Now {
  std::int64_t utime_us = 0;  // this host's UTC
  double monotonic_s = 0.0;
};

struct Outgoing {
  std::string subject;
  Headers headers;
};

struct Counts {
  std::uint64_t passed = 0;
  std::array<std::uint64_t, static_cast<std::size_t>(Refusal::kCount)> refused{};
  std::string last_refusal{};
};

// The id and epoch of a target. Both go out with the target and with commands about it.
struct Grant {
  std::string id;            // the target's id, the same for all fusions; empty: no target (a
                             // search)
  std::uint64_t epoch = 0;   // 0: ownership is not used
  bool is_confirmed = true;  // false: the owner's lease has ended, because the store does not
                             // answer
  std::string owner{};       // name and start of a fusion
};
// Returns the grant for a message; nullopt if this fusion must not publish the message's target.
using Owned = std::function<std::optional<Grant>(Kind, Bytes)>;

// Reads the claim from a message's headers; nullopt if no bridge would write such headers.
std::optional<Claim> claim_of(const Headers& headers);

class Passage {
 public:
  explicit Passage(PassageConfig config) : config_(std::move(config)) {}

  // The subject and headers under which a message from the bus goes out; nullopt: it does not pass.
  // `bytes`: as received, with the signature. `owned`: called for targets, and for commands that
  // concern a target.
  std::optional<Outgoing> out(std::string_view channel, Bytes bytes, const Now& now,
                              const Owned& owned = {});
  // The channel on which a message from the network goes to the bus, with the same bytes; nullopt:
  // it does not pass.
  std::optional<std::string> in(std::string_view subject, const Headers& headers, Bytes bytes,
                                const Now& now);
  // Whether another owner's target is a valid message, and is fresh enough for its position to be
  // used.
  bool hears_target(std::string_view subject, Bytes bytes, const Now& now);

  // What to subscribe to, on the bus (a regular expression) and on the network.
  std::string channels() const;
  std::vector<std::string> subjects() const;

  const Counts& out_counts() const { return out_; }
  const Counts& in_counts() const { return in_; }
  // The greatest epoch of a command that came in; 0: no command stated an epoch.
  std::uint64_t greatest_epoch() const { return epochs_.greatest(); }
  const SequenceWatch& gaps() const { return gaps_; }
  // The last live message that came in too late ("alfa, 12 s"), if that was recent; otherwise
  // empty.
  std::string late(double now_s) const;
  std::size_t stations() const { return places_.size(); }
  // By site: the time since the last message of any of its stations.
  std::map<std::string, double> sites_ago_s(double now_s) const {
    return places_.sites_ago_s(now_s);
  }

 private:
  // Limits of the number of channels with a rate. For messages of stations: two channels for each
  // station that the bridge may know, plus one. Commands have a limit of their own, because they
  // may name stations that do not exist.
  static constexpr std::size_t kMostChannels = 2 * StationPlaces::kMost + 1, kMostCommands = 10'000;
  using Judged = std::optional<Refusal>;

  // Why a message does not pass. nullopt: it passes, and the last argument holds the result.
  Judged judge_out(std::string_view channel, Bytes bytes, const Now& now, const Owned& owned,
                   Outgoing& outgoing);
  Judged judge_in(std::string_view text, const Headers& headers, Bytes bytes, const Now& now,
                  std::string& channel);
  Judged address(const Content& content, const Now& now, Subject& subject);
  static Judged judge_form(const Content& content, std::string_view channel, Bytes bytes,
                           trust::MessageHead& head);
  Judged judge_rate(const Content& content, std::string_view channel, const Now& now);
  Judged judge_age(const Content& content, const trust::MessageHead& head, const Now& now);
  Judged take(const Subject& subject, const Now& now);
  Judged obey(const Subject& subject, const Headers& headers, const Now& now);
  bool settles(const Subject& subject, const Now& now);
  bool is_ours(const std::string& station) const;

  const PassageConfig config_;
  StationPlaces places_;
  ChannelRateLimits rates_{kMostChannels}, command_rates_{kMostCommands};
  EpochFence epochs_;
  SequenceWatch gaps_;
  std::string late_;
  double late_s_ = -1e9;
  Counts out_, in_;
};

}  // namespace ols::bridge
