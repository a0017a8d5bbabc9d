#include "bridge/stream_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bridge/subject.h"

namespace ols::bridge {
namespace {

using testing::ElementsAre;

BridgeConfig config(Role role, std::vector<std::string> sources = {}) {
  BridgeConfig config;
  config.role = role;
  config.region = "r";
  config.site = "s";
  config.targets = true;
  config.commands = commands();
  config.archive.is_on = true;
  config.archive.sources = std::move(sources);
  return config;
}

bool keeps(const StreamPlan& plan, const std::string& subject) {
  for (const std::string& pattern : plan.subjects) {
    if (covers(pattern, subject)) return true;
  }
  return false;
}

TEST(StreamPlan, NothingIsKeptByDefault) { EXPECT_FALSE(plan_stream(BridgeConfig())); }

TEST(StreamPlan, ACommandNeverEntersAStream) {
  for (const BridgeConfig& one :
       {config(Role::kSite), config(Role::kRegion), config(Role::kRegion, {"s"})}) {
    const auto plan = plan_stream(one);
    ASSERT_TRUE(plan);
    for (const std::string& command : commands()) {
      EXPECT_FALSE(keeps(*plan, "ols.v1.r.s.alfa.cmd." + command)) << command;
    }
    EXPECT_FALSE(keeps(*plan, "ols.v1.r.s.alfa.cmd"));
  }
}

TEST(StreamPlan, ASiteKeepsItsOwnForADay) {
  const auto plan = plan_stream(config(Role::kSite));
  EXPECT_EQ(plan->name, "OLS_r_s");
  EXPECT_EQ(plan->keep_ns, 86'400'000'000'000);
  EXPECT_TRUE(keeps(*plan, "ols.v1.r.s.alfa.bearing"));
  EXPECT_TRUE(keeps(*plan, "ols.v1.r.s.alfa.status"));
  EXPECT_TRUE(keeps(*plan, "ols.v1.r.target"));
  EXPECT_FALSE(keeps(*plan, "ols.v1.r.other.alfa.bearing"));
}

TEST(StreamPlan, ARegionCopiesItsSitesAndHearsThemOnlyOnce) {
  const auto plan = plan_stream(config(Role::kRegion, {"s", "t"}));
  EXPECT_EQ(plan->name, "OLS_r");
  ASSERT_EQ(plan->sources.size(), 2U);
  EXPECT_EQ(plan->sources[1].stream, "OLS_r_t");
  EXPECT_EQ(plan->sources[1].domain, "t");
  EXPECT_THAT(plan->subjects, ElementsAre("ols.v1.r.target"));
  EXPECT_TRUE(keeps(*plan_stream(config(Role::kRegion)), "ols.v1.r.s.alfa.bearing"));
}

TEST(StreamPlan, AStreamOfAnotherPlaceIsNotTheSame) {
  const BridgeConfig site = config(Role::kSite), region = config(Role::kRegion, {"s"});
  EXPECT_TRUE(is_same_stream(site, {"ols.v1.r.s.*.bearing", "ols.v1.r.target"}, {}));
  EXPECT_FALSE(is_same_stream(site, {"ols.v1.r.s.*.bearing", "ols.v1.r.t.*.bearing"}, {}));
  EXPECT_FALSE(is_same_stream(site, {"ols.v1.rs.*.*.bearing"}, {}));
  EXPECT_FALSE(is_same_stream(site, {"orders"}, {}));
  EXPECT_TRUE(is_same_stream(region, {"ols.v1.r.target"}, {"OLS_r_s", "OLS_r_t"}));
  EXPECT_FALSE(is_same_stream(region, {"ols.v1.r.target"}, {"OLS_other_s"}));
}

TEST(StreamPlan, ItTakesNoMoreRoomThanItMay) {
  BridgeConfig site = config(Role::kSite);
  site.archive.most_bytes = 5e9;
  EXPECT_EQ(plan_stream(site)->most_bytes, 5'000'000'000);
}

TEST(StreamPlan, WildcardsCoverAsNatsHasIt) {
  EXPECT_TRUE(covers("a.*.c", "a.b.c"));
  EXPECT_TRUE(covers("a.>", "a.b.c"));
  EXPECT_FALSE(covers("a.*", "a.b.c"));
  EXPECT_FALSE(covers("a.b.c", "a.b"));
  EXPECT_FALSE(covers("a.>", "a"));
}

}  // namespace
}  // namespace ols::bridge
