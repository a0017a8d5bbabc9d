#include "central/offline/smoother.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using namespace test;

constexpr double kNoise = 3e-4;

// Those with a position; counts the reasons of the other instants.
std::vector<Smoothed> smooth(const std::vector<BearingMeasurement>& bearings,
                             const std::vector<std::int64_t>& epochs,
                             const TrackManagerConfig& config, const KnownStations& known,
                             Unlocated& unlocated) {
  std::vector<Smoothed> fixes;
  const auto take = [&](Smoothed fix) {
    const Solution solution = fix.located.estimate.solution;
    if (solution != Solution::kOk) {
      ++unlocated[solution];
    } else {
      fixes.push_back(std::move(fix));
    }
  };
  fusion::smooth(pointers_to(bearings), epochs, config, known, {take});
  return fixes;
}

KnownStations nothing_known() { return {BiasModel(), {}}; }

std::vector<std::int64_t> every_tenth_of(double seconds) {
  std::vector<std::int64_t> epochs;
  for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i) {
    epochs.push_back(kStart + i * 100'000);
  }
  return epochs;
}

TEST(Smoother, JoinsWhatWasBeforeWithWhatComesAfter) {
  const auto bearings = flight(4.0, kNoise, kNoise);
  const auto epochs = every_tenth_of(3.9);
  Unlocated unlocated;
  const auto smoothed = smooth(bearings, epochs, {}, nothing_known(), unlocated);
  ASSERT_EQ(smoothed.size(), epochs.size());
  RecordedTrack causal{TrackManagerConfig{}};
  auto next = bearings.begin();
  double smoothed_m = 0.0, causal_m = 0.0;
  int surer = 0, fixes = 0;
  for (const Smoothed& fix : smoothed) {
    for (; next != bearings.end() && next->utime_us <= fix.utime_us; ++next) causal.add(*next);
    const double t_s = 1e-6 * static_cast<double>(fix.utime_us - kStart);
    const Eigen::Vector3d truth = site().to_ecef(path(t_s));
    ASSERT_EQ(fix.located.estimate.solution, Solution::kOk);
    if (causal.located() == nullptr || t_s > 3.0) continue;
    const KinematicState state = causal.located()->filter.at(fix.utime_us);
    smoothed_m += (fix.located.estimate.position_ecef - truth).norm();
    causal_m += (state.mean.head<3>() - truth).norm();
    surer += fix.located.estimate.covariance_ecef.trace() <
             state.covariance.topLeftCorner<3, 3>().trace();
    ++fixes;
  }
  ASSERT_GT(fixes, 20);
  EXPECT_LT(smoothed_m, causal_m);
  EXPECT_EQ(surer, fixes);
}

TEST(Smoother, CountsWhyThereIsNoPosition) {
  auto bearings = flight(1.0, kNoise, kNoise);
  std::erase_if(bearings, [](const BearingMeasurement& s) { return s.station != "a"; });
  Unlocated unlocated;
  EXPECT_TRUE(smooth(bearings, every_tenth_of(0.9), {}, nothing_known(), unlocated).empty());
  std::size_t sum = 0;
  for (const auto& [why, count] : unlocated) sum += count;
  EXPECT_EQ(sum, 9U);
  EXPECT_TRUE(smooth({}, {}, {}, nothing_known(), unlocated).empty());
}

// Twenty stations around the flight, each ten times a second: more than have states of their own.
// The forward filter gives those to the first twelve, the backward one to the last.
constexpr int kTwenty = 20;

// Their headings are off by what they state.
std::vector<BearingMeasurement> of_twenty(double seconds, double heading_sd_rad) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  std::array<double, kTwenty> heading{};
  for (double& own : heading) own = heading_sd_rad * normal(random);
  std::vector<BearingMeasurement> bearings;
  for (int i = 0; i < static_cast<int>(seconds * 10.0) * kTwenty; ++i) {
    const auto station = static_cast<std::size_t>(i % kTwenty);
    const double t_s = i / (10.0 * kTwenty), angle = 2.0 * kPi * (i % kTwenty) / kTwenty;
    const Eigen::Vector3d place(300.0 * std::cos(angle), 300.0 * std::sin(angle), 0.0);
    Ray ray = ray_to(std::to_string(station), place, path(t_s), kNoise);
    ray.sight.direction.azimuth_rad += heading[station];
    ray = turned(ray, kNoise * normal(random), kNoise * normal(random));
    const double cosine = std::cos(ray.sight.direction.elevation_rad);
    ray.sight.covariance_systematic(0, 0) = std::pow(heading_sd_rad * cosine, 2);
    bearings.push_back(measurement_of(ray, kStart + std::llround(t_s * 1e6)));
  }
  return bearings;
}

// Mean squared error, and its ratio to what is stated.
struct Score {
  double squared_m2 = 0.0, over_stated = 0.0;
};

Score score_of(const std::vector<Smoothed>& fixes) {
  Score score;
  for (const Smoothed& fix : fixes) {
    const double t_s = static_cast<double>(fix.utime_us - kStart) * 1e-6;
    const Eigen::Vector3d off = fix.located.estimate.position_ecef - site().to_ecef(path(t_s));
    const double count = static_cast<double>(fixes.size());
    score.squared_m2 += off.squaredNorm() / count;
    score.over_stated += off.squaredNorm() / fix.located.estimate.covariance_ecef.trace() / count;
  }
  return score;
}

std::vector<Smoothed> smooth_twenty(double heading_sd_rad) {
  const auto bearings = of_twenty(4.0, heading_sd_rad);
  Unlocated unlocated;
  auto fixes = smooth(bearings, every_tenth_of(4.0), {}, nothing_known(), unlocated);
  EXPECT_GE(fixes.size(), 38U);
  return fixes;
}

// What the surer filter has no states for is known from the other one.
TEST(Smoother, OfTwentyStationsWithHeadingsOff) {
  const Score score = score_of(smooth_twenty(5e-3));
  EXPECT_LT(std::sqrt(score.squared_m2), 0.1);
  EXPECT_LT(score.over_stated, 1.5);
}

// Each station follows a point of the target that is fixed in metres; another one after half of the
// time, when it is designated again.
std::vector<BearingMeasurement> of_points(double seconds, double sd_m, std::uint64_t seed) {
  constexpr int kStations = 4;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::array<std::array<Eigen::Vector3d, 2>, kStations> points;
  for (std::size_t i = 0; i < kStations; ++i) {
    for (const std::size_t designation : {0, 1}) {
      const Eigen::Vector3d point =
          sd_m * Eigen::Vector3d(normal(random), normal(random), normal(random));
      const Eigen::Vector3d along = (path(0.5 * seconds * designation) - square()[i]).normalized();
      points[i][designation] = point - 0.8 * along.dot(point) * along;
    }
  }
  std::vector<BearingMeasurement> bearings;
  for (int i = 0; i < static_cast<int>(seconds * 15.0) * kStations; ++i) {
    const auto station = static_cast<std::size_t>(i % kStations);
    const double t_s = i / (15.0 * kStations);
    const std::size_t designation = t_s < 0.5 * seconds ? 0 : 1;
    Ray ray = ray_to(std::to_string(station), square()[station],
                     path(t_s) + points[station][designation], kNoise);
    ray = turned(ray, kNoise * normal(random), kNoise * normal(random));
    ray.sight.origin_sd_enu_m.setZero();
    ray.sight.aim_sd_rad = sd_m / (path(t_s) - square()[station]).norm();
    ray.sight.covariance_systematic.diagonal().array() += std::pow(ray.sight.aim_sd_rad, 2);
    bearings.push_back(measurement_of(ray, kStart + std::llround(t_s * 1e6)));
    bearings.back().track_id = static_cast<std::int64_t>(designation + 1);
  }
  return bearings;
}

TEST(Smoother, APointOfTheTargetIsFollowedUntilTheNextDesignation) {
  constexpr double kSeconds = 8.0;
  constexpr int kSeeds = 20;
  Score mean;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Unlocated unlocated;
    const Score score = score_of(smooth(of_points(kSeconds, 0.5, seed), every_tenth_of(kSeconds),
                                        {}, nothing_known(), unlocated));
    mean.squared_m2 += score.squared_m2 / kSeeds;
    mean.over_stated += score.over_stated / kSeeds;
  }
  EXPECT_LT(std::sqrt(mean.squared_m2), 0.45);
  EXPECT_GT(mean.over_stated, 0.7);
  EXPECT_LT(mean.over_stated, 1.3);
}

// To and fro, and once more block by block where not all instants are one block.
TEST(Smoother, SaysHowOftenItRunsOverTheBearings) {
  EXPECT_EQ(smoother_runs(1), 2U);
  EXPECT_EQ(smoother_runs(100), 2U);
  EXPECT_EQ(smoother_runs(100'000), 3U);
}

// All are reported, whether a filter has states for them or not.
TEST(Smoother, OfTwentyStations) {
  const auto bearings = of_twenty(4.0, 0.0);
  Unlocated unlocated;
  const auto fixes = smooth(bearings, every_tenth_of(4.0), {}, nothing_known(), unlocated);
  ASSERT_GE(fixes.size(), 38U);
  double squared = 0.0;
  for (const Smoothed& fix : fixes) {
    const double t_s = static_cast<double>(fix.utime_us - kStart) * 1e-6;
    const Eigen::Vector3d off = fix.located.estimate.position_ecef - site().to_ecef(path(t_s));
    EXPECT_LT(off.norm(), 0.2) << t_s;
    squared += off.squaredNorm() / fix.located.estimate.covariance_ecef.trace();
    if (t_s > 1.0 && t_s < 3.0) {
      EXPECT_EQ(fix.located.stations.size(), 20U) << t_s;
    }
  }
  EXPECT_LT(squared / static_cast<double>(fixes.size()), 1.5);
}

}  // namespace
}  // namespace ols::fusion
