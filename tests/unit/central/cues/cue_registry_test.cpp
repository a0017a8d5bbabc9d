#include "central/cues/cue_registry.h"

#include <gtest/gtest.h>

#include "tests/unit/central/cues/cue_scene.h"

namespace ols::fusion {
namespace {

using test::good_cue;
using test::kCueTime_us;

Track track_at(std::int64_t id, const Eigen::Vector3d& p_ecef) {
  Track track(TrackFilter({}, kCueTime_us,
                          {.p_ecef = p_ecef, .position_sd_m = 5.0, .velocity_sd_m_s = 1.0}));
  track.id = id;
  track.state = TrackState::kConfirmed;
  return track;
}

Eigen::Vector3d beside(const Cue& cue, double east_m) {
  return ecef_from_geodetic(cue.place) + R_ecef_enu(cue.place) * Eigen::Vector3d(east_m, 0.0, 0.0);
}

class TheCueRegistry : public testing::Test {
 protected:
  CueRegistry with(CueAllowance allow) {
    CueConfig config;
    config.allow = allow;
    config.most = 2;
    CueRegistry registry(config);
    EXPECT_EQ(registry.take(good_cue(), kCueTime_us, stations_), CueRefusal::kNone);
    return registry;
  }
  static CueState state(const CueRegistry& registry) {
    return registry.health(kCueTime_us).at(0).state;
  }

  StationRegistry stations_ = test::one_station();
};

TEST_F(TheCueRegistry, WaitsForTheOperatorsWord) {
  CueRegistry registry = with(CueAllowance::kAsk);
  EXPECT_EQ(state(registry), CueState::kWaiting);
  EXPECT_TRUE(registry.aims(kCueTime_us).empty());
  EXPECT_FALSE(registry.order("tak.other", true));
  EXPECT_TRUE(registry.order("tak.a", true));
  EXPECT_EQ(state(registry), CueState::kSearched);
  EXPECT_EQ(registry.aims(kCueTime_us).size(), 1U);
  EXPECT_TRUE(registry.order("tak.a", false));
  EXPECT_EQ(state(registry), CueState::kForbidden);
  EXPECT_TRUE(registry.aims(kCueTime_us).empty());
}

TEST_F(TheCueRegistry, AStandingWordHoldsUntilAnOperatorSaysNo) {
  CueRegistry registry = with(CueAllowance::kAll);
  EXPECT_EQ(registry.aims(kCueTime_us).size(), 1U);
  EXPECT_TRUE(registry.order("tak.a", false));
  EXPECT_TRUE(registry.aims(kCueTime_us).empty());
}

TEST_F(TheCueRegistry, WhereTheSiteWantsNoneAnOperatorCannotAllowIt) {
  CueRegistry registry = with(CueAllowance::kNever);
  EXPECT_FALSE(registry.order("tak.a", true));
  EXPECT_EQ(state(registry), CueState::kForbidden) << "and it is shown";
  EXPECT_TRUE(registry.aims(kCueTime_us).empty());
}

// The word is for what was shown: what leaps is another object.
TEST_F(TheCueRegistry, TheWordEndsWhereTheCueLeaps) {
  CueRegistry registry = with(CueAllowance::kAsk);
  registry.order("tak.a", true);
  Cue next = good_cue();
  next.utime_us = next.state_us = kCueTime_us + 1'000'000;
  EXPECT_EQ(registry.take(next, next.utime_us, stations_), CueRefusal::kNone);
  EXPECT_EQ(state(registry), CueState::kSearched);
  next.place = geodetic_from_ecef(beside(next, 5000.0));
  EXPECT_EQ(registry.take(next, next.utime_us, stations_), CueRefusal::kNone);
  EXPECT_EQ(state(registry), CueState::kWaiting);
  registry.order("tak.a", false);
  next.place = good_cue().place;
  EXPECT_EQ(registry.take(next, next.utime_us, stations_), CueRefusal::kNone);
  EXPECT_EQ(state(registry), CueState::kForbidden) << "a no holds";
}

// The word is for this object; another one later may have its name.
TEST_F(TheCueRegistry, TheWordEndsWithTheCue) {
  CueRegistry registry = with(CueAllowance::kAsk);
  registry.order("tak.a", true);
  registry.end_silent(kCueTime_us + 1'900'000);
  EXPECT_FALSE(registry.empty());
  registry.end_silent(kCueTime_us + 2'100'000);
  EXPECT_TRUE(registry.empty());
  Cue again = good_cue();
  again.utime_us = again.state_us = kCueTime_us + 3'000'000;
  EXPECT_EQ(registry.take(again, again.utime_us, stations_), CueRefusal::kNone);
  EXPECT_EQ(state(registry), CueState::kWaiting);
}

TEST_F(TheCueRegistry, ATargetThatIsThereEndsTheSearch) {
  CueRegistry registry = with(CueAllowance::kAll);
  registry.settle(kCueTime_us, {track_at(7, beside(good_cue(), 20.0))});
  EXPECT_EQ(state(registry), CueState::kFound);
  EXPECT_EQ(registry.health(kCueTime_us)[0].target_id, 7);
  EXPECT_TRUE(registry.aims(kCueTime_us).empty());
  registry.settle(kCueTime_us + 200'000, {track_at(7, beside(good_cue(), 200.0))});
  EXPECT_EQ(state(registry), CueState::kSearched) << "that one is somewhere else";
  Track tentative = track_at(8, beside(good_cue(), 0.0));
  tentative.state = TrackState::kTentative;
  registry.settle(kCueTime_us + 400'000, {tentative});
  EXPECT_EQ(state(registry), CueState::kSearched);
}

TEST_F(TheCueRegistry, OfTwoTargetsThereTheOneBeforeCounts) {
  CueRegistry registry = with(CueAllowance::kAll);
  const Track seven = track_at(7, beside(good_cue(), 5.0)),
              nine = track_at(9, beside(good_cue(), 0));
  registry.settle(kCueTime_us, {nine});
  registry.settle(kCueTime_us + 200'000, {seven, nine});
  EXPECT_EQ(registry.health(kCueTime_us)[0].target_id, 9);
}

TEST_F(TheCueRegistry, HasRoomForSoManyAndTakesNoOvertakenPlace) {
  CueRegistry registry = with(CueAllowance::kAll);
  Cue other = good_cue();
  other.id = "tak.b";
  EXPECT_EQ(registry.take(other, kCueTime_us, stations_), CueRefusal::kNone);
  other.id = "tak.c";
  EXPECT_EQ(registry.take(other, kCueTime_us, stations_), CueRefusal::kTooMany);
  Cue older = good_cue();
  older.state_us -= 500'000;
  EXPECT_EQ(registry.take(older, kCueTime_us, stations_), CueRefusal::kStale);
  other.id = "tak.b";
  other.place.latitude_rad += 0.1;
  EXPECT_EQ(registry.take(other, kCueTime_us, stations_), CueRefusal::kOutOfArea);
}

TEST_F(TheCueRegistry, SaysWhereACueIsNow) {
  CueRegistry registry = with(CueAllowance::kAsk);
  Cue cue = good_cue();
  cue.velocity_enu_m_s = {0.0, 0.0, 10.0};
  EXPECT_EQ(registry.take(cue, kCueTime_us, stations_), CueRefusal::kNone);
  const CueHealth health = registry.health(kCueTime_us + 1'000'000).at(0);
  EXPECT_NEAR(health.place.height_m, 410.0, 1e-6);
  EXPECT_NEAR(health.age_s, 1.0, 1e-9);
  EXPECT_GT(health.horizontal_sd_m, 10.0);
  EXPECT_GT(health.vertical_sd_m, 20.0);
}

}  // namespace
}  // namespace ols::fusion
