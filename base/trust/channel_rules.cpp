#include "base/trust/channel_rules.h"

#include <algorithm>
#include <array>

#include "base/bus/channel_names.h"

namespace ols::trust {
namespace {

constexpr double kTracker_Hz = 400.0, kStatus_Hz = 20.0, kPictures_Hz = 100.0;
constexpr double kReplies_Hz = 1000.0;     // several people each repeat a stop 50 times a second
constexpr double kFrameParts_Hz = 2000.0;  // a whole frame is sent as fast as the loop turns
constexpr double kSite_Hz = 20'000.0;      // slews to a thousand stations
constexpr double kTargets_Hz = 2000.0;
constexpr double kHand_Hz = 200.0;  // of a person's orders, to all stations together
// Orders to one station. The fusion is configured for 100 slews/s at most. A joystick sends ten
// orders a second, to the unit and to the lens. A person's clicks are fewer.
constexpr double kSlew_Hz = 120.0, kJoystick_Hz = 50.0, kClick_Hz = 20.0;
constexpr double kCues_Hz = 2000.0;
constexpr double kSimulator_Hz = 20'000.0;

constexpr ChannelRule of_station(std::string_view name, double rate_hz, bool fresh = true) {
  return {name, true, Role::kStation, HeadForm::kStationFirst, false, fresh, rate_hz};
}
constexpr ChannelRule command(std::string_view name, Role sender, double rate_hz,
                              double station_rate_hz) {
  return {name, true, sender, HeadForm::kBootFirst, true, true, rate_hz, station_rate_hz};
}
constexpr ChannelRule of_fusion(std::string_view name, double rate_hz) {
  return {name, false, Role::kFusion, HeadForm::kBootFirst, false, true, rate_hz};
}

constexpr auto numbered(auto rules) {
  for (std::size_t i = 0; i < rules.size(); ++i) rules[i].index = i;
  return rules;
}

constexpr auto kRules = numbered(std::array{
    of_station(kBearingChannel, kTracker_Hz),
    of_station(kSightingChannel, kStatus_Hz),
    of_station(kSkylineChannel, kStatus_Hz),
    // A station whose clock is wrong must still be seen, and be stopped.
    of_station(kStatusChannel, kStatus_Hz, false),
    of_station(kReplyChannel, kReplies_Hz, false),
    of_station(kPreviewChannel, kPictures_Hz),
    of_station(kFrameChannel, kFrameParts_Hz),
    command(kSlewChannel, Role::kFusion, kSite_Hz, kSlew_Hz),
    command(kOcclusionChannel, Role::kFusion, kSite_Hz, kSlew_Hz),
    command(kPtuChannel, Role::kOperator, kHand_Hz, kJoystick_Hz),
    command(kLensChannel, Role::kOperator, kHand_Hz, kJoystick_Hz),
    command(kDesignateChannel, Role::kOperator, kHand_Hz, kClick_Hz),
    command(kRecordChannel, Role::kOperator, kHand_Hz, kClick_Hz),
    command(kFrameRequestChannel, Role::kOperator, kHand_Hz, kClick_Hz),
    // Between a procedure and its operator: the station takes no part.
    ChannelRule{kProcedureChannel, true, Role::kOperator, HeadForm::kStationFirst, false, true,
                kPictures_Hz},
    ChannelRule{kProcedureAnswerChannel, true, Role::kOperator, HeadForm::kBootFirst, false, true,
                kHand_Hz},
    of_fusion(kTargetChannel, kTargets_Hz),
    of_fusion(kPaperTargetChannel, kTargets_Hz),
    of_fusion(kFusionStatusChannel, kStatus_Hz),
    ChannelRule{kCueChannel, false, Role::kCue, HeadForm::kBootFirst, false, true, kCues_Hz},
    // Orders to the fusion name no boot: an allowance ends with its cue anyway.
    ChannelRule{kCueOrderChannel, false, Role::kOperator, HeadForm::kBootFirst, false, true,
                kHand_Hz},
    ChannelRule{kCueReplyChannel, false, Role::kFusion, HeadForm::kStationFirst, false, true,
                kReplies_Hz},
    ChannelRule{kIncidentChannel, false, Role::kOperator, HeadForm::kBootFirst, false, true,
                kHand_Hz},
    // Anybody may pass the trust list and the site's settings on: the root has signed them.
    ChannelRule{kTrustChannel, false, Role::kListener, HeadForm::kBootFirst, false, false,
                kStatus_Hz},
    ChannelRule{kSiteChannel, false, Role::kListener, HeadForm::kBootFirst, false, false,
                kStatus_Hz},
    ChannelRule{"OLS_SIM_", true, Role::kSimulator, HeadForm::kUtimeOnly, false, false,
                kSimulator_Hz},
});

constexpr std::array<std::pair<Role, const char*>, 6> kRoles{{{Role::kStation, "station"},
                                                              {Role::kFusion, "fusion"},
                                                              {Role::kOperator, "operator"},
                                                              {Role::kSimulator, "simulator"},
                                                              {Role::kCue, "cue"},
                                                              {Role::kListener, "listener"}}};

bool matches(const ChannelRule& rule, std::string_view channel) {
  if (!rule.with_station) return channel == rule.name;
  return channel.starts_with(rule.name) && channel.size() > rule.name.size();
}

}  // namespace

const char* to_string(Role role) {
  if (role == Role::kUnknown) return "unknown";
  return std::ranges::find(kRoles, role, &std::pair<Role, const char*>::first)->second;
}

std::optional<Role> role_from(std::string_view word) {
  for (const auto& [role, name] : kRoles) {
    if (word == name) return role;
  }
  return std::nullopt;
}

std::span<const ChannelRule> rules() { return kRules; }

std::optional<Channel> rule_of(std::string_view channel) {
  const ChannelRule* best = nullptr;
  for (const ChannelRule& rule : kRules) {
    if (!matches(rule, channel)) continue;
    if (best == nullptr || rule.name.size() > best->name.size()) best = &rule;
  }
  if (best == nullptr) return std::nullopt;
  return Channel{best, channel.substr(best->name.size())};
}

bool may_send(Role role, std::string_view name, const Channel& channel) {
  if (role == Role::kUnknown) return false;
  if (channel.rule->name == kTrustChannel || channel.rule->name == kSiteChannel) return true;
  if (role != channel.rule->sender) return false;
  return role != Role::kStation || channel.station == name;
}

}  // namespace ols::trust
