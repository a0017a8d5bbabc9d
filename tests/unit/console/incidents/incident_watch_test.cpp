#include "console/incidents/incident_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::console {
namespace {

constexpr double kLatitude_deg = 48.0;
constexpr double kMetre_deg = 1.0 / 111'200.0;  // of latitude

Area area_named(const std::string& name, std::vector<std::string> classes = {}) {
  return {name,
          {{11.0, kLatitude_deg},
           {11.02, kLatitude_deg},
           {11.02, kLatitude_deg + 0.02},
           {11.0, kLatitude_deg + 0.02}},
          0.0,
          500.0,
          std::move(classes),
          22 * 60,
          6 * 60};
}

// `north_m`: of the southern border.
WatchedTarget target_north(double north_m, const std::string& id = "5/1", double sd_m = 3.0,
                           std::int64_t utime_us = 1'000'000) {
  WatchedTarget target;
  target.utime_us = utime_us;
  target.id = id;
  target.position = {radians(kLatitude_deg + north_m * kMetre_deg), radians(11.01), 100.0};
  target.covariance_enu_m2 = sd_m * sd_m * Eigen::Matrix3d::Identity();
  target.stations = {"alfa", "bravo"};
  return target;
}

constexpr int kNight = 23 * 60, kDay = 12 * 60;

IncidentWatch watch_of(const std::vector<Area>& areas) {
  IncidentWatch watch;
  for (const Area& area : areas) watch.set(area);
  return watch;
}

TEST(IncidentWatch, OneIncidentForATargetInAnAreaHoweverOftenItComesBack) {
  IncidentWatch watch = watch_of({area_named("Gate")});
  struct Step {
    double north_m;
    bool is_inside;
    int entries;
  };
  // Sure to be outside, undecided, sure to be inside, undecided, outside, inside again.
  watch.receive(target_north(-20), kNight, 0.0);
  watch.receive(target_north(3), kNight, 0.0);
  EXPECT_TRUE(watch.incidents().empty());
  for (const Step& step : {Step{10, true, 1}, Step{-3, true, 1}, Step{-20, false, 1},
                           Step{3, false, 1}, Step{30, true, 2}}) {
    watch.receive(target_north(step.north_m), kNight, 0.0);
    watch.receive(target_north(step.north_m), kNight, IncidentWatch::kLeaves_s);
    ASSERT_EQ(watch.incidents().size(), 1U);
    EXPECT_EQ(watch.incidents().at(1).is_inside(), step.is_inside) << step.north_m;
    EXPECT_EQ(watch.incidents().at(1).entries, step.entries) << step.north_m;
  }
  EXPECT_EQ(watch.take_changes().entered, (std::vector<std::uint64_t>{1, 1}));
  EXPECT_TRUE(watch.take_changes().entered.empty());
  watch.receive(target_north(30, "5/2"), kNight, 0.0);
  EXPECT_EQ(watch.incidents().at(2).target_number(), "2");
  EXPECT_EQ(watch.incidents().at(2).stations, (std::vector<std::string>{"alfa", "bravo"}));
}

// What hysteresis is for: docs/events.md has the figures. A filter's error lasts about two seconds.
TEST(IncidentWatch, ATargetThatHoversAtTheBorderRingsSeldom) {
  constexpr unsigned kSeed = 41;
  constexpr double kPeriod_s = 0.2, kLasts_s = 2.0, kSd_m = 3.0, kHour_s = 3600.0;
  RecordProperty("seed", static_cast<int>(kSeed));
  std::mt19937 random(kSeed);
  std::normal_distribution<double> normal;
  const double kept = std::exp(-kPeriod_s / kLasts_s);
  IncidentWatch watch = watch_of({area_named("Gate")});
  double error_m = 0.0;
  int crossings = 0;
  bool was_north = false;
  for (double t_s = 0.0; t_s < kHour_s; t_s += kPeriod_s) {
    error_m = kept * error_m + std::sqrt(1.0 - kept * kept) * kSd_m * normal(random);
    const bool is_north = error_m > 0.0;
    crossings += is_north && !was_north ? 1 : 0;
    was_north = is_north;
    watch.receive(target_north(error_m, "5/1", kSd_m), kNight, t_s);
  }
  const int entries = watch.incidents().at(1).entries;
  std::printf("entries an hour at the border: %d; with one threshold of 0.5: %d (seed %u)\n",
              entries, crossings, kSeed);
  EXPECT_LE(entries, 2);
  EXPECT_GT(crossings, 1000);
}

TEST(IncidentWatch, EndsWhenTheTargetHasSurelyBeenOutsideForAWhile) {
  IncidentWatch watch = watch_of({area_named("Gate")});
  const auto is_inside_at = [&](double now_s, double north_m, double sd_m = 3.0) {
    watch.receive(target_north(north_m, "5/1", sd_m, std::llround(now_s * 1e6)), kNight, now_s);
    watch.turn(now_s);
    return watch.incidents().at(1).is_inside();
  };
  EXPECT_TRUE(is_inside_at(1.0, 50));
  for (double now_s = 2.0; now_s < 60.0; now_s += 1.0) EXPECT_TRUE(is_inside_at(now_s, -50, NAN));
  EXPECT_TRUE(is_inside_at(60.0, -20));
  EXPECT_TRUE(is_inside_at(64.9, -20));
  EXPECT_TRUE(is_inside_at(64.95, -3)) << "it might be inside: this begins anew";
  EXPECT_TRUE(is_inside_at(65.0, -20));
  EXPECT_TRUE(is_inside_at(69.9, -20));
  EXPECT_FALSE(is_inside_at(70.0, -20));
  EXPECT_EQ(watch.incidents().at(1).ended_us, 64'950'000) << "when it left";
  EXPECT_EQ(watch.incidents().at(1).last.utime_us, 64'950'000) << "not thinned out as the track";
}

TEST(IncidentWatch, BeginsForItsClassesAtItsTimeOnly) {
  IncidentWatch watch = watch_of({area_named("Gate", {"drone"})});
  WatchedTarget target = target_north(50);
  watch.receive(target, kNight, 0.0);
  target.object_class = "drone";
  watch.receive(target, kDay, 0.0);
  EXPECT_TRUE(watch.incidents().empty());
  watch.receive(target, kNight, 0.0);
  ASSERT_EQ(watch.incidents().size(), 1U);
  // What it is and what time it is may change meanwhile.
  target.object_class = "bird";
  target.utime_us = 9'000'000;
  watch.receive(target, kDay, 0.0);
  EXPECT_TRUE(watch.incidents().at(1).is_inside());
  EXPECT_EQ(watch.incidents().at(1).object_class, "bird");
  EXPECT_EQ(watch.incidents().at(1).track.size(), 2U);
}

TEST(IncidentWatch, ADismissedTargetDoesNotComeBackInAnyArea) {
  IncidentWatch watch = watch_of({area_named("Gate")});
  watch.receive(target_north(50), kNight, 0.0);
  EXPECT_TRUE(watch.incidents().at(1).is_alarm());
  ASSERT_TRUE(watch.judge(1, Judgement::kDismissed, "ana", 7));
  EXPECT_FALSE(watch.judge(9, Judgement::kDismissed, "ana", 7));
  EXPECT_FALSE(watch.incidents().at(1).is_alarm());
  EXPECT_EQ(watch.incidents().at(1).judged_by, "ana");
  watch.set(area_named("Roof"));
  watch.receive(target_north(-50), kNight, 0.0);
  watch.receive(target_north(-50), kNight, IncidentWatch::kLeaves_s);
  watch.receive(target_north(50), kNight, 0.0);
  EXPECT_EQ(watch.incidents().size(), 1U);
  EXPECT_FALSE(watch.incidents().at(1).is_inside());
  watch.judge(1, Judgement::kOpen, "ana", 8);
  watch.receive(target_north(50), kNight, 0.0);
  EXPECT_EQ(watch.incidents().size(), 2U);
}

TEST(IncidentWatch, EndsWithItsTargetOrItsArea) {
  IncidentWatch watch = watch_of({area_named("Gate"), area_named("Roof")});
  watch.receive(target_north(50, "5/1", 3.0, 4'000'000), kNight, 10.0);
  ASSERT_TRUE(watch.remove("Roof"));
  EXPECT_FALSE(watch.remove("Roof"));
  EXPECT_EQ(watch.incidents().at(2).ended_us, 4'000'000);
  watch.turn(10.0 + IncidentWatch::kLost_s);
  EXPECT_TRUE(watch.incidents().at(1).is_inside());
  watch.turn(10.1 + IncidentWatch::kLost_s);
  EXPECT_EQ(watch.incidents().at(1).ended_us, 4'000'000);
  watch.receive(target_north(50), kNight, 50.0);
  watch.drop("5/1");
  EXPECT_FALSE(watch.incidents().at(1).is_inside());
}

TEST(IncidentWatch, GoesOnAfterARestart) {
  IncidentWatch before = watch_of({area_named("Gate")});
  before.receive(target_north(50), kNight, 0.0);
  before.receive(target_north(50, "5/2"), kNight, 0.0);
  before.judge(2, Judgement::kDismissed, "ana", 7);
  before.set_picture(1, {{"station", "alfa"}});
  std::vector<Incident> kept;
  for (const auto& [number, incident] : before.incidents()) {
    kept.push_back(incident_from(json_of(incident)));
    EXPECT_EQ(json_of(kept.back()), json_of(incident));
  }
  IncidentWatch after;
  after.resume(before.areas(), kept, 7, 100.0);
  after.receive(target_north(50), kNight, 101.0);
  after.receive(target_north(50, "5/2"), kNight, 101.0);
  EXPECT_TRUE(after.take_changes().entered.empty());
  after.receive(target_north(50, "5/3"), kNight, 101.0);
  EXPECT_EQ(after.take_changes().entered, std::vector<std::uint64_t>{8});
  after.turn(100.5 + IncidentWatch::kLost_s);
  EXPECT_TRUE(after.incidents().at(1).is_inside());
  IncidentWatch without;
  without.resume({}, kept, 7, 100.0);
  EXPECT_FALSE(without.incidents().at(1).is_inside()) << "nobody watches its area";
  nlohmann::json bad = json_of(kept[0]);
  bad.erase("area");
  EXPECT_THROW(incident_from(bad), std::invalid_argument);
  bad = json_of(kept[0]);
  bad["verdict"] = "guilty";
  EXPECT_THROW(incident_from(bad), std::invalid_argument);
}

// Those that are over first, of these the dismissed ones, then the confirmed ones.
TEST(IncidentWatch, ForgetsWhatMattersLeastAndStillKnowsADismissedTarget) {
  IncidentWatch watch = watch_of({area_named("Gate")});
  const auto enter = [&](std::size_t i) {
    watch.receive(target_north(50, "5/" + std::to_string(i)), kNight, 0.0);
  };
  for (std::size_t i = 1; i <= IncidentWatch::kMostIncidents; ++i) enter(i);
  for (const char* left : {"5/2", "5/3", "5/4", "5/5"}) watch.drop(left);
  for (const std::uint64_t number : {1, 4, 5}) watch.judge(number, Judgement::kDismissed, "a", 1);
  watch.judge(3, Judgement::kConfirmed, "a", 1);
  for (std::size_t i = 1; i <= 6; ++i) enter(1000 + i);
  EXPECT_EQ(watch.take_changes().forgotten, (std::vector<std::uint64_t>{4, 5, 3, 2, 1, 6}));
  EXPECT_EQ(watch.incidents().size(), IncidentWatch::kMostIncidents);
  enter(4);
  EXPECT_TRUE(watch.take_changes().entered.empty()) << "it was dismissed";
  watch.drop("5/4");
  enter(4);
  EXPECT_EQ(watch.take_changes().entered.size(), 1U) << "this is another";
}

TEST(IncidentTrack, IsThinnedOutAsItGrows) {
  Incident incident;
  const std::int64_t period_us = incident.track_period_us;
  add_to_track({-60'000'000, 0.0, 0.0, 0.0}, incident);  // long before the next: it was away
  for (int i = 0; i < 10; ++i) add_to_track({i * period_us, 0.0, 0.0, 1.0 * i}, incident);
  EXPECT_EQ(incident.track.size(), 11U);
  for (int i = 10; i < 2000; ++i) add_to_track({i * period_us, 0.0, 0.0, 1.0 * i}, incident);
  EXPECT_LE(incident.track.size(), kMostTrackPoints);
  EXPECT_GE(incident.track.size(), kMostTrackPoints / 2);
  EXPECT_EQ(incident.track.front().utime_us, -60'000'000);
  EXPECT_GT(incident.track.back().utime_us, 1970 * period_us);
}

}  // namespace
}  // namespace ols::console
