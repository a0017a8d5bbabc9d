#include "bridge/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ols::bridge {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

BridgeStatus well() {
  BridgeStatus status;
  status.link.is_open = true;
  status.out.passed = 120;
  status.archive = {true, true, "", 5, 500, {}};
  status.ownership.is_wanted = true;
  return status;
}

TEST(BridgeStatus, AllIsWell) {
  EXPECT_THAT(alarms(well()), IsEmpty());
  EXPECT_EQ(in_one_line(well()), "connected; out 120; in 0");
}

TEST(BridgeStatus, EachConditionIsAnAlarm) {
  BridgeStatus status = well();
  status.link.is_open = false;
  status.link.trouble = std::string("gone");
  status.link.refusal = std::string("Permissions Violation");
  status.gap = std::string("alfa");
  status.late = std::string("bravo, 20 s");
  status.archive.is_kept = false;
  status.archive.trouble = std::string("full");
  status.archive.standing = {"airfield"};
  status.ownership.is_confirmed = false;
  status.ownership.delay_s = 1.0;
  EXPECT_THAT(
      alarms(status),
      ElementsAre(
          "bridge: no server: gone", "bridge: the server refuses: Permissions Violation",
          "bridge: messages are missing: alfa", "bridge: late messages are dropped: bravo, 20 s",
          "bridge: the archive does not work: full", "bridge: the archive of airfield stands still",
          "bridge: the store of owners does not answer, no target changes its owner",
          "bridge: the store of owners is too slow for so many targets"));
  EXPECT_THAT(in_one_line(status), HasSubstr("not connected"));
}

TEST(BridgeStatus, WhatIsNormalIsNoRefusal) {
  BridgeStatus status = well();
  status.out.refused[static_cast<std::size_t>(Refusal::kOwn)] = 5;
  status.out.refused[static_cast<std::size_t>(Refusal::kNotOwned)] = 5;
  EXPECT_EQ(in_one_line(status), "connected; out 120; in 0");
  status.in.refused[static_cast<std::size_t>(Refusal::kStale)] = 2;
  status.in.last_refusal = std::string("x: stale");
  status.obeyed_epoch = 12;
  EXPECT_THAT(in_one_line(status), HasSubstr("in 0, 2 refused (last x: stale)"));
  const auto json = nlohmann::json::parse(to_json(status));
  EXPECT_EQ(json["in"]["refused"]["stale"], 2);
  EXPECT_EQ(json["out"]["refused"]["own"], 5);
  EXPECT_EQ(json["link"]["open"], true);
  EXPECT_EQ(json["archive"]["messages"], 5);
  EXPECT_EQ(json["ownership"]["obeyed_epoch"], 12);
}

TEST(BridgeStatus, ASiteThatIsHeardAndNotCopiedStandsStill) {
  const std::map<std::string, double> heard{{"a", 0.1}, {"b", 0.1}, {"c", 100.0}, {"d", 0.1}};
  const std::map<std::string, double> archived{{"a", 1.0}, {"b", 40.0}, {"c", 100.0}};
  EXPECT_THAT(standing_still(heard, archived, 30.0), ElementsAre("b"));
}

}  // namespace
}  // namespace ols::bridge
