#include "central/tracking/track_initiation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "dev/estimators/bearing_world.h"
#include "tests/unit/central/wrong_heading.h"

namespace ols::fusion {
namespace {

using test::kStart;
using test::off_by;
using test::watch;

struct Live {
  double first_s = 1e9;  // the first position
  double worst_m = 0.0;  // largest error
  std::string named;     // stations in quarantine
  Solution last = Solution::kOk;
};

Live live(const std::vector<BearingMeasurement>& measurements) {
  Fusion fusion(FusionConfig{});
  Live result;
  for (const FusedTarget& target : test::targets_of(fusion, measurements)) {
    result.last = target.estimate.solution;
    if (result.last != Solution::kOk) continue;
    const double t_s = static_cast<double>(target.utime_us - kStart) * 1e-6;
    result.first_s = std::min(result.first_s, t_s);
    result.worst_m = std::max(result.worst_m, test::slow_error_m(target));
  }
  for (const StationHealth& station : fusion.health().stations) {
    if (!station.quarantine.empty()) result.named += station.station;
  }
  return result;
}

// Two stations that agree make a fix in about a second; a wrong third one must not prevent that, in
// any order of exposures.
TEST(TrackInitiation, OneWrongStationOfThreeKeepsTheOthersFromNothing) {
  for (const double off_deg : {5.0, -5.0, 2.0, 90.0}) {
    std::string order = "abc";
    do {
      const auto measurements = watch(order, 6.0, 1e-4, off_by('c', off_deg), 1e-4);
      const Live found = live(measurements);
      EXPECT_LT(found.first_s, 1.5) << order << ' ' << off_deg;
      EXPECT_LT(found.worst_m, 1.0) << order << ' ' << off_deg;
      // 90 deg off it may follow another object.
      EXPECT_EQ(found.named, off_deg == 90.0 ? "" : "c") << order << ' ' << off_deg;
    } while (std::ranges::next_permutation(order).found);
  }
}

TEST(TrackInitiation, WhicheverOfTheThreeIsWrong) {
  for (const char wrong : {'a', 'b'}) {
    std::string order = "abc";
    do {
      const Live found = live(watch(order, 6.0, 1e-4, off_by(wrong, 5.0), 1e-4));
      EXPECT_LT(found.first_s, 1.5) << order << ' ' << wrong;
      EXPECT_LT(found.worst_m, 1.0) << order << ' ' << wrong;
      EXPECT_EQ(found.named, std::string(1, wrong)) << order;
    } while (std::ranges::next_permutation(order).found);
  }
}

TEST(TrackInitiation, AStationThatFollowsSomethingElseKeepsTheOthersFromNothing) {
  const test::HeadingError elsewhere = [](char name, double t_s) {
    return name == 'c' ? 0.3 + 0.1 * t_s : 0.0;
  };
  std::string order = "abc";
  do {
    const Live found = live(watch(order, 3.0, 1e-4, elsewhere, 1e-4));
    EXPECT_LT(found.first_s, 1.5) << order;
    EXPECT_LT(found.worst_m, 1.0) << order;
  } while (std::ranges::next_permutation(order).found);
}

TEST(TrackInitiation, SaysThatRaysMiss) {
  const test::HeadingError each_elsewhere = [](char name, double) {
    return 0.35 * (name - 'a' + 1);
  };
  EXPECT_EQ(live(watch("abc", 2.0, 1e-4, each_elsewhere, 1e-4)).last, Solution::kRaysMiss);
  EXPECT_EQ(live(watch("ab", 0.2, 1e-4, off_by('c', 0.0), 1e-4)).last, Solution::kTooFewRays);
}

// The evidence of a hypothesis on the stations counts once it is a track; that of failed ones does
// not.
TEST(TrackInitiation, AStartThatIsRejectedTeachesNothing) {
  TrackInitiation initiation({}, {});
  BiasModel errors;
  bool begun = false;
  for (const BearingMeasurement& measurement : watch("abcd", 1.0, 5e-4, off_by('c', 0.0))) {
    const auto start = initiation.add(measurement, errors, false);
    begun = start.has_value();
    if (begun) errors.learn(start->evidence);
    if (begun) break;
    for (const char* station : {"a", "b", "c", "d"}) {
      EXPECT_EQ(errors.noise_scale(station), 1.0);
    }
  }
  EXPECT_TRUE(begun);
  EXPECT_NE(errors.noise_scale("a"), 1.0);
}

// Undeclared drift of headings up to 2 deg is learnt; after a while without a target, all four find
// the next one at once.
TEST(TrackInitiation, StationsWithGreatLearntBiasesFindTheNextTarget) {
  constexpr double kDriftS = 350.0, kEndS = kDriftS + 8.0;
  constexpr double kDriftRadS = 1e-4;
  bench::WorldConfig world{.stations_enu = bench::circle(4, 300.0), .aims_enu = {}};
  world.noise_rad = 1e-3;
  world.rate_hz = 15.0;
  std::mt19937_64 random(1);
  const auto path = bench::cruising({{30, 20, 80}, {0, 0, 0}}, 1e-3, kEndS, random);
  Fusion fusion(FusionConfig{.paper_targets = 0});
  double first_s = 1e9;
  for (BearingMeasurement measurement : bench::measure(world, {path}, kEndS, random)) {
    const double t_s = 1e-6 * static_cast<double>(measurement.utime_us - bench::kStartUs);
    const double sign = measurement.station == "s0" || measurement.station == "s2" ? 1.0 : -1.0;
    double& azimuth = measurement.sight.direction.azimuth_rad;
    azimuth = wrap_two_pi(azimuth + sign * kDriftRadS * std::min(t_s, kDriftS));
    if (t_s > kDriftS && t_s < kDriftS + 6.0) continue;
    if (t_s <= kDriftS && kDriftS - t_s < 0.1) {
      const BiasPrior prior = fusion.tracks().errors().prior("s0", measurement.sight, 300.0);
      EXPECT_GT(std::sqrt(prior.covariance(0, 0)), 0.01);
    }
    for (const FusedTarget& target : fusion.add(measurement).targets) {
      if (target.estimate.solution != Solution::kOk || target.stations.size() < 4) continue;
      if (t_s > kDriftS) first_s = std::min(first_s, t_s - kDriftS - 6.0);
    }
  }
  EXPECT_LT(first_s, 0.5);
}

}  // namespace
}  // namespace ols::fusion
