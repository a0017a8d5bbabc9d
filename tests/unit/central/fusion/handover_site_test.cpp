// Hand-over in simulated time: detectors see, the fusion decides, stations turn.
#include "dev/estimators/handover_site.h"

#include <gtest/gtest.h>

#include "dev/estimators/bearing_world.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;
using fusion::HandoverMode;

constexpr std::uint64_t kSeed = 4;

// Four stations that turn, and an overview station.
HandoverSiteConfig site_with(HandoverMode mode, std::vector<FlyingTarget> targets) {
  HandoverSiteConfig config;
  config.stations_enu = circle(4, 100.0);
  config.overview_enu = Vector3d(0, 0, 5);
  config.targets = std::move(targets);
  config.handover.mode = mode;
  return config;
}

// In the view of some stations that look to the north, and slow enough to stay there for a while.
FlyingTarget in_the_north() {
  return {.p_enu = {0, 600, 120}, .v_enu = {4, 0, 0}, .appears_s = 1.0};
}
FlyingTarget in_the_south() {
  return {.p_enu = {-50, -250, 80}, .v_enu = {10, 2, 0}, .appears_s = 1.0};
}

TEST(HandoverSite, OffWhatTheOverviewFindsLeadsNobody) {
  HandoverSite site(site_with(HandoverMode::kOff, {in_the_south()}), kSeed);
  site.run_until(15.0);
  EXPECT_TRUE(site.first_seen_s(0));
  EXPECT_TRUE(site.holders(0).empty());
}

TEST(HandoverSite, AutomaticAllStationsHaveItSoon) {
  HandoverSite site(site_with(HandoverMode::kAutomatic, {in_the_south()}), kSeed);
  site.run_until(15.0);
  EXPECT_NE(site.found(0), 0);
  EXPECT_EQ(site.holders(0).size(), 4U);
}

TEST(HandoverSite, AProposedTargetLeadsStationsOnceItIsAllowedAndNoMoreWhenItIsDismissed) {
  HandoverSiteConfig config = site_with(HandoverMode::kPropose, {in_the_north()});
  config.view_rad = 0.35;
  config.stations_enu = circle(4, 300.0);
  HandoverSite site(config, kSeed);
  site.run_until(8.0);
  const std::size_t by_chance = site.holders(0).size();
  const std::int64_t id = site.found(0);
  ASSERT_NE(id, 0);
  ASSERT_LT(by_chance, 4U);
  EXPECT_EQ(site.fusion().health().cues.at(0).state, fusion::CueState::kWaiting);
  EXPECT_TRUE(site.fusion().allow_cue(std::to_string(id), true));
  site.run_until(14.0);
  EXPECT_EQ(site.holders(0).size(), 4U);
  const double slews = site.fusion().health().counters.at("slews");
  EXPECT_TRUE(site.fusion().allow_cue(std::to_string(id), false));
  site.run_until(20.0);
  EXPECT_LE(site.fusion().health().counters.at("slews"), slews + 4.0);
}

TEST(HandoverSite, AStationThatStaresIsNeverLed) {
  HandoverSiteConfig config = site_with(HandoverMode::kAutomatic, {in_the_south()});
  config.handover.staring = {name_of_station(0)};
  config.view_rad = 0.16;
  HandoverSite site(config, kSeed);
  site.run_until(15.0);
  EXPECT_EQ(site.holders(0).size(), 3U);
}

TEST(HandoverSite, TheLineOfWhatIsOfNoClassIsNotSearchedWhereOthersLead) {
  HandoverSiteConfig config = site_with(HandoverMode::kAutomatic, {in_the_south()});
  config.handover.classes = {fusion::ObjectClass::kDrone};
  HandoverSite site(config, kSeed);
  site.run_until(8.0);
  EXPECT_EQ(site.fusion().health().counters.at("slews"), 0.0);
}

// All stations have followed the first one when a second one appears elsewhere.
TEST(HandoverSite, StationsThatFollowTheFirstTargetGiveTheSecondItsShare) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    HandoverSiteConfig config =
        site_with(HandoverMode::kAutomatic, {in_the_north(), in_the_south()});
    config.stations_track = true;
    config.targets[1].appears_s = 15.0;
    HandoverSite site(config, seed);
    site.run_until(15.0);
    ASSERT_EQ(site.holders(0).size(), 4U) << "seed " << seed;
    site.run_until(30.0);
    EXPECT_NE(site.found(0), 0) << "seed " << seed;
    EXPECT_NE(site.found(1), 0) << "seed " << seed;
    EXPECT_GE(site.holders(0).size(), 2U) << "seed " << seed;
    EXPECT_GE(site.holders(1).size(), 1U) << "seed " << seed;
  }
}

// What only the overview can see is searched for 10 s; as a new one after a restart, again.
TEST(HandoverSite, TheLineOfATrackletIsNotSearchedForEver) {
  HandoverSiteConfig config = site_with(HandoverMode::kAutomatic, {in_the_south()});
  config.view_rad = 0.0;
  HandoverSite site(config, kSeed);
  const auto slews_until = [&](double time_s) {
    const auto slews = [&] { return site.fusion().health().counters.at("slews"); };
    const double before = slews();
    site.run_until(time_s);
    return slews() - before;
  };
  EXPECT_GT(slews_until(12.0), 0.0);
  slews_until(13.0);
  EXPECT_EQ(slews_until(20.0), 0.0);
  site.restart_stations();
  EXPECT_GT(slews_until(24.0), 0.0);
}

}  // namespace
}  // namespace ols::bench
