// Which role may send on which channel and how often, and the form of each channel's messages.
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
  kListener,   // sends only what the root has signed; its key lets a logger or a doctor read the
               // bus
  kUnknown,    // from a list newer than this program: may send nothing
};
const char* to_string(Role role);
// nullopt for an unknown word.
std::optional<Role> role_from(std::string_view word);

struct ChannelRule {
  std::string_view name;  // the whole channel, or its beginning if a station's name follows
  bool with_station = false;
  Role sender = Role::kStation;
  HeadForm head = HeadForm::kStationFirst;
  bool is_command = false;  // its trailer names the boot of the addressed station
  bool must_be_fresh = true;
  double rate_hz = 0.0;  // limit per key; a burst may have one second's worth
  // Limit per key and station, if that is lower; 0: none. A station applies only this limit.
  double station_rate_hz = 0.0;
  std::size_t index = 0;  // among rules()
};

std::span<const ChannelRule> rules();
inline constexpr std::string_view kTrustChannel = "OLS_TRUST";
inline constexpr std::string_view kSiteChannel = "OLS_SITE";

struct Channel {
  const ChannelRule* rule = nullptr;
  std::string_view station;  // from the channel's name; empty for a site channel
};
// The rule with the longest matching name: OLS_FRAME_REQUEST_a must not be taken for the frames of
// a station REQUEST_a. nullopt for an unknown channel.
std::optional<Channel> rule_of(std::string_view channel);

// Whether a member of this role and name may send on the channel.
bool may_send(Role role, std::string_view name, const Channel& channel);

}  // namespace ols::trust
