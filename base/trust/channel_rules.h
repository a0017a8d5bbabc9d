// Which role may send on which channel, how often, and how the messages of each channel begin.
// Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/trust/message_head.h"

namespace ols::trust {

enum class Role {
  kStation,    // sends on its own channels only
  kFusion,     // sends targets, slews and its status
  kOperator,   // sends commands and procedures
  kSimulator,  // sends the simulator's own messages
  kCue,        // sends cues from outside
  kListener,   // only receives, and passes on texts that the root has signed; for example
               // ols-logger
  kUnknown,    // a role that this program does not know, from a newer trust list; may send nothing
};
const char* to_string(Role role);
// nullopt for an unknown word.
std::optional<Role> role_from(std::string_view word);

struct ChannelRule {
  std::string_view name;  // the channel, or its beginning if a station's name follows
  bool with_station = false;
  Role sender = Role::kStation;
  HeadForm head = HeadForm::kStationFirst;
  bool is_command = false;  // its trailer names the boot of the addressed station
  bool must_be_fresh = true;
  double rate_hz = 0.0;  // limit per key; a burst may have as many messages as one second allows
  // A lower limit, per key and addressed station; 0: none. At a station, which receives only the
  // commands to itself, this limit is reached first.
  double station_rate_hz = 0.0;
  std::size_t index = 0;  // position in rules()
};

std::span<const ChannelRule> rules();
inline constexpr std::string_view kTrustChannel = "OLS_TRUST";
inline constexpr std::string_view kSiteChannel = "OLS_SITE";

struct Channel {
  const ChannelRule* rule = nullptr;
  std::string_view station;  // from the channel's name; empty for a site channel
};
// The channel's rule and station. Of all rules whose name matches, the longest name counts:
// OLS_FRAME_REQUEST_a is a request to station a, not a frame of a station REQUEST_a. nullopt for an
// unknown channel.
std::optional<Channel> rule_of(std::string_view channel);

// Whether a member of this role and name may send on the channel.
bool may_send(Role role, std::string_view name, const Channel& channel);

}  // namespace ols::trust
