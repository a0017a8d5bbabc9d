// Cues from outside in the whole fusion: whom they lead where, and what they never touch.
#include <gtest/gtest.h>

#include "central/fusion/fusion.h"
#include "geometry/angles.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::kStart;
using test::site;

Cue cue_at(const Vector3d& p_enu, std::int64_t utime_us, double sd_m = 2.0) {
  Cue cue;
  cue.id = "tak.a";
  cue.utime_us = cue.state_us = utime_us;
  cue.place = geodetic_from_ecef(site().to_ecef(p_enu));
  cue.horizontal_sd_m = cue.vertical_sd_m = sd_m;
  cue.velocity_sd_m_s = 1.0;
  return cue;
}

FusionConfig allowing(CueAllowance allow) {
  FusionConfig config;
  config.cues.allow = allow;
  return config;
}

void know(Fusion& fusion, const std::string& id, const Vector3d& p_enu, bool commandable = true) {
  fusion.know_station(id, {.camera_ecef = site().to_ecef(p_enu),
                           .field_of_view_rad = 0.07,
                           .axis = AzimuthElevation{0.0, 0.1},
                           .commandable = commandable});
}

double off_rad(const Slew& slew, const Vector3d& from_enu, const Vector3d& to_enu) {
  const auto expected = test::direction_to(site().to_ecef(from_enu), site().to_ecef(to_enu));
  return angle_between(enu_from_azimuth_elevation(slew.direction),
                       enu_from_azimuth_elevation(expected));
}

// Nobody sees anything: no bearing has ever come.
TEST(FusionCues, LeadStationsThatSeeNothingOnceAnOperatorAllowsIt) {
  Fusion fusion(allowing(CueAllowance::kAsk));
  know(fusion, "a", {0, 0, 0});
  know(fusion, "b", {200, 0, 0});
  know(fusion, "held", {0, 200, 0}, false);
  const Vector3d there(100, 300, 80);
  EXPECT_TRUE(fusion.add(cue_at(there, kStart), kStart).empty());
  EXPECT_TRUE(fusion.allow_cue("tak.a", true));
  const auto slews = fusion.add(cue_at(there, kStart + 200'000), kStart + 200'000);
  ASSERT_EQ(slews.size(), 2U);
  EXPECT_LT(off_rad(slews[0], {0, 0, 0}, there), 1e-3);
  EXPECT_LT(off_rad(slews[1], {200, 0, 0}, there), 1e-3);
  EXPECT_EQ(slews[0].target_id, 0) << "no position of ours";
  EXPECT_TRUE(fusion.allow_cue("tak.a", false));
  EXPECT_TRUE(fusion.add(cue_at(there, kStart + 400'000), kStart + 400'000).empty());
}

TEST(FusionCues, RefusedOnesAreCountedAndNamed) {
  Fusion fusion(allowing(CueAllowance::kAll));
  know(fusion, "a", {0, 0, 0});
  EXPECT_TRUE(fusion.add(cue_at({0, 50e3, 100}, kStart), kStart).empty());
  EXPECT_EQ(fusion.health().counters.at("cues_out_of_area"), 1.0);
  EXPECT_EQ(fusion.health().last_error, "cue tak.a: too far from every station");
  EXPECT_TRUE(fusion.add(cue_at({0, 100, 100}, kStart), kStart + 20'000'000).empty());
  EXPECT_EQ(fusion.health().counters.at("cues_stale"), 1.0);
  EXPECT_EQ(fusion.health().counters.at("cues"), 0.0);
  EXPECT_FALSE(fusion.allow_cue("tak.a", true));
  EXPECT_EQ(fusion.health().counters.at("cue_orders_refused"), 1.0);
}

// A clock that goes back in the middle of a round of more stations than are slewed at once.
TEST(FusionCues, AStepBackBeginsANewRound) {
  const FusionConfig config = allowing(CueAllowance::kAll);
  StationRegistry stations({}, 100);
  for (int i = 0; i < 40; ++i) {
    MessageTime time;
    StationTraits& traits =
        stations.for_status(std::string(1, static_cast<char>('A' + i)), time).station->traits;
    traits.camera_ecef = site().to_ecef(Vector3d(10.0 * i, 0, 0));
    traits.commandable = true;
  }
  CueRegistry cues(config.cues);
  ASSERT_EQ(cues.take(cue_at({100, 300, 80}, kStart), kStart, stations), CueRefusal::kNone);
  const LiveTracks tracks(config.tracks);
  const PointingMonitor pointing;
  const BearingLines lines(tracks, pointing, config.estimators.alignment);
  SlewSchedule schedule({}, 1.0);
  const auto first = schedule.plan(kStart, stations, lines, {}, cues, HandoverPolicy({}));
  ASSERT_TRUE(schedule.is_in_round());
  const auto again = schedule.plan(kStart - 600'000, stations, lines, {}, cues, HandoverPolicy({}));
  ASSERT_FALSE(again.empty());
  EXPECT_EQ(again.front().station, first.front().station);
}

// A cue that is far off, and certain of itself, beside the same bearings; its clock and this host's
// differ from theirs.
TEST(FusionCues, NeverMoveAFix) {
  Fusion alone{FusionConfig{}}, cued(allowing(CueAllowance::kAll));
  std::size_t fixes = 0;
  for (const BearingMeasurement& bearing : test::flight(5.0, 1e-4)) {
    const FusionOutput expected = alone.add(bearing);
    const std::int64_t present_us = bearing.utime_us + (fixes % 2 == 0 ? 700'000 : -700'000);
    static_cast<void>(cued.add(cue_at({30, 30, 60}, present_us - 100'000, 0.5), present_us));
    const FusionOutput output = cued.add(bearing);
    ASSERT_EQ(output.targets.size(), expected.targets.size());
    for (std::size_t i = 0; i < output.targets.size(); ++i) {
      const Estimate &one = output.targets[i].estimate, &other = expected.targets[i].estimate;
      if (other.solution != Solution::kOk) continue;
      ++fixes;
      EXPECT_EQ(one.position_ecef, other.position_ecef);
      EXPECT_EQ(one.covariance_ecef, other.covariance_ecef);
    }
  }
  EXPECT_GT(fixes, 20U);
  EXPECT_GT(cued.health().counters.at("cues"), 20.0);
}

// Four stations see a target; the fifth, which sees nothing, goes where nobody looks.
TEST(FusionCues, TakeNoStationFromWhatItSees) {
  Fusion fusion(allowing(CueAllowance::kAll));
  std::int64_t now_us = 0;
  for (const BearingMeasurement& bearing : test::flight(4.0, 1e-4)) {
    static_cast<void>(fusion.add(bearing));
    now_us = bearing.utime_us;
  }
  know(fusion, "fifth", {50, 400, 0});
  const Vector3d there(900, 900, 80);
  std::vector<Slew> slews;
  for (int i = 6; i <= 8; ++i) {  // without bearings the cue's time goes on
    const std::int64_t then_us = now_us + i * 100'000;
    for (const Slew& slew : fusion.add(cue_at(there, then_us), then_us)) slews.push_back(slew);
  }
  std::size_t to_cue = 0;
  for (const Slew& slew : slews) {
    if (slew.target_id != 0) continue;
    ++to_cue;
    EXPECT_EQ(slew.station, "fifth");
    EXPECT_LT(off_rad(slew, {50, 400, 0}, there), 1e-2);
  }
  EXPECT_GE(to_cue, 1U);
  EXPECT_GT(slews.size(), to_cue);
}

// A ray that passes the cue says where, the cue how far.
TEST(FusionCues, OneThatAStationsRayPassesIsSearchedAlongThatRay) {
  Fusion fusion(allowing(CueAllowance::kAll));
  know(fusion, "a", {0, 0, 0});
  know(fusion, "b", {400, 0, 0});
  const Vector3d there(0, 500, 50);
  std::vector<Slew> slews;
  for (int i = 0; i < 30; ++i) {
    const std::int64_t now_us = kStart + i * 66'667;
    BearingMeasurement bearing = test::flight(0.1, 1e-4).front();
    bearing.station = "a";
    bearing.utime_us = now_us;
    bearing.track_id = 5;
    bearing.sight.origin_ecef = site().to_ecef({0, 0, 0});
    bearing.sight.direction = test::direction_to(bearing.sight.origin_ecef, site().to_ecef(there));
    static_cast<void>(fusion.add(cue_at({30, 480, 80}, now_us, 40.0), now_us));
    for (const Slew& slew : fusion.add(bearing).slews) slews.push_back(slew);
  }
  ASSERT_FALSE(slews.empty());
  const Slew& last = slews.back();
  EXPECT_EQ(last.station, "b");
  EXPECT_FALSE(last.line.isZero());
  // On the ray of a, and no more than its share of the cue's uncertainty away from it.
  EXPECT_LT(off_rad(last, {400, 0, 0}, there), 0.2);
}

}  // namespace
}  // namespace ols::fusion
