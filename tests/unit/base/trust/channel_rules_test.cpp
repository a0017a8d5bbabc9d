#include "base/trust/channel_rules.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace ols::trust {
namespace {

bool may(Role role, std::string_view name, std::string_view channel) {
  const auto rule = rule_of(channel);
  return rule && may_send(role, name, *rule);
}

TEST(ChannelRules, AStationSendsOnItsOwnChannelsOnly) {
  for (const char* kind : {"BEARING", "SIGHTING", "SKYLINE", "STATUS", "PREVIEW", "FRAME"}) {
    const std::string channel = "OLS_" + std::string(kind) + "_";
    EXPECT_TRUE(may(Role::kStation, "alfa", channel + "alfa")) << kind;
    EXPECT_FALSE(may(Role::kStation, "bravo", channel + "alfa")) << kind;
    EXPECT_FALSE(may(Role::kOperator, "alfa", channel + "alfa")) << kind;
    EXPECT_FALSE(may(Role::kFusion, "alfa", channel + "alfa")) << kind;
  }
  EXPECT_FALSE(may(Role::kStation, "alfa", "OLS_PTU_alfa"));
  EXPECT_FALSE(may(Role::kStation, "alfa", "OLS_TARGET"));
}

TEST(ChannelRules, AStationWithATrickyNameCommandsNothing) {
  EXPECT_FALSE(may(Role::kStation, "REQUEST_alfa", "OLS_FRAME_REQUEST_alfa"));
  EXPECT_FALSE(may(Role::kOperator, "x", "OLS_FRAME_alfa"));
  EXPECT_EQ(rule_of("OLS_FRAME_REQUEST_alfa")->station, "alfa");
  EXPECT_EQ(rule_of("OLS_PROCEDURE_ANSWER_alfa")->station, "alfa");
}

TEST(ChannelRules, FusionAndOperatorDoNotSendForEachOther) {
  for (const char* channel : {"OLS_TARGET", "OLS_TARGET_PAPER", "OLS_FUSION_STATUS",
                              "OLS_SLEW_alfa", "OLS_OCCLUSION_alfa"}) {
    EXPECT_TRUE(may(Role::kFusion, "fusion", channel)) << channel;
    EXPECT_FALSE(may(Role::kOperator, "anna", channel)) << channel;
  }
  for (const char* channel : {"OLS_PTU_alfa", "OLS_DESIGNATE_alfa", "OLS_RECORD_alfa",
                              "OLS_FRAME_REQUEST_alfa", "OLS_PROCEDURE_alfa"}) {
    EXPECT_TRUE(may(Role::kOperator, "anna", channel)) << channel;
    EXPECT_FALSE(may(Role::kFusion, "fusion", channel)) << channel;
    EXPECT_FALSE(may(Role::kListener, "logger", channel)) << channel;
  }
}

// Whoever tells of targets commands nobody, and lets nobody be led to what he tells.
TEST(ChannelRules, CuesComeFromTheirOwnRoleAndAreAllowedByOperators) {
  EXPECT_TRUE(may(Role::kCue, "cue", "OLS_CUE"));
  for (const char* channel : {"OLS_CUE_ORDER", "OLS_SLEW_alfa", "OLS_PTU_alfa", "OLS_TARGET",
                              "OLS_FUSION_STATUS", "OLS_BEARING_cue", "OLS_CUE_alfa"}) {
    EXPECT_FALSE(may(Role::kCue, "cue", channel)) << channel;
  }
  EXPECT_TRUE(may(Role::kOperator, "anna", "OLS_INCIDENT"));
  EXPECT_FALSE(may(Role::kCue, "cue", "OLS_INCIDENT"));
  EXPECT_TRUE(may(Role::kOperator, "anna", "OLS_CUE_ORDER"));
  for (const Role role : {Role::kOperator, Role::kFusion, Role::kListener, Role::kStation}) {
    EXPECT_FALSE(may(role, "x", "OLS_CUE"));
  }
}

TEST(ChannelRules, AnybodyPassesTheTrustListOnAndNobodyOwnsOtherChannels) {
  for (const Role role : {Role::kStation, Role::kFusion, Role::kListener}) {
    EXPECT_TRUE(may(role, "x", "OLS_TRUST"));
    EXPECT_TRUE(may(role, "x", "OLS_SITE"));
    EXPECT_FALSE(may(role, "x", "OLS_TRUST_alfa"));
    EXPECT_FALSE(may(role, "x", "CHAT"));
    EXPECT_FALSE(may(role, "x", "OLS_SIM_TRUTH"));
  }
  EXPECT_TRUE(may(Role::kSimulator, "x", "OLS_SIM_TRUTH"));
  EXPECT_FALSE(rule_of("OLS_BEARING_")) << "of nobody";
}

// What a station hears of one sender: not what a site of a thousand stations may.
TEST(ChannelRules, EveryCommandHasALimitTowardsOneStation) {
  const std::map<std::string, double> most_hz{
      {"OLS_SLEW_alfa", 120.0},        {"OLS_OCCLUSION_alfa", 120.0}, {"OLS_PTU_alfa", 50.0},
      {"OLS_LENS_alfa", 50.0},         {"OLS_DESIGNATE_alfa", 20.0},  {"OLS_RECORD_alfa", 20.0},
      {"OLS_FRAME_REQUEST_alfa", 20.0}};
  for (const auto& [channel, hz] : most_hz) {
    EXPECT_EQ(rule_of(channel)->rule->station_rate_hz, hz) << channel;
  }
  for (const ChannelRule& rule : rules()) {
    EXPECT_EQ(rule.is_command, rule.station_rate_hz > 0.0) << rule.name;
    EXPECT_LE(rule.station_rate_hz, rule.rate_hz) << rule.name;
  }
}

TEST(ChannelRules, EveryRoleIsReadByItsWordAndEveryRuleHasANumberAndARate) {
  for (const char* word : {"station", "fusion", "operator", "simulator", "cue", "listener"}) {
    ASSERT_TRUE(role_from(word)) << word;
    EXPECT_STREQ(to_string(*role_from(word)), word);
  }
  EXPECT_FALSE(role_from("root"));
  std::set<std::size_t> numbers;
  for (const ChannelRule& rule : rules()) {
    EXPECT_GE(rule.rate_hz, 1.0) << rule.name;
    numbers.insert(rule.index);
  }
  EXPECT_EQ(*numbers.rbegin(), rules().size() - 1);
  EXPECT_EQ(numbers.size(), rules().size());
}

}  // namespace
}  // namespace ols::trust
