// Which role may send on which channel, how often, and the form of each channel's messages. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/trust/message_head.h"

namespace ols::trust {

enum class Role {
  kStation,    // its own channels only
  kFusion,     // targets, slews, its status
  kOperator,   // commands, procedures
  kSimulator,  // what only the simulator says
  kCue,        // cues from outside
  kListener,   // only what the root has signed; its key lets a logger or a doctor read the bus
  kUnknown,    // in a list that is newer than this program: may send nothing
};
const char* to_string(Role role);
// Nothing for a word that is none of them.
std::optional<Role> role_from(std::string_view word);

struct ChannelRule {
  std::string_view name;  // the whole channel; or its beginning, if a station's name follows
  bool with_station = false;
  Role sender = Role::kStation;
  HeadForm head = HeadForm::kStationFirst;
  bool is_command = false;  // names the boot of the station that it is meant for
  bool must_be_fresh = true;
  double rate_hz = 0.0;  // from one key; a second's worth at once
  // From one key to one station, where that is less: at the station it is the only limit. 0: none.
  double station_rate_hz = 0.0;
  std::size_t index = 0;  // among rules()
};

std::span<const ChannelRule> rules();
inline constexpr std::string_view kTrustChannel = "OLS_TRUST";
inline constexpr std::string_view kSiteChannel = "OLS_SITE";

struct Channel {
  const ChannelRule* rule = nullptr;
  std::string_view station;  // of the channel's name; empty for one of the site
};
// The rule with the longest name: OLS_FRAME_REQUEST_a is not the frames of a station REQUEST_a.
// Nothing for a channel of nobody.
std::optional<Channel> rule_of(std::string_view channel);

// Whether a member of this role and name may send there.
bool may_send(Role role, std::string_view name, const Channel& channel);

}  // namespace ols::trust
