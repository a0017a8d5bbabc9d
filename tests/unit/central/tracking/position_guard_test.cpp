#include "central/tracking/position_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::kStart;
using test::site;
using test::square;

const Vector3d kTarget(-30.0, 300.0, 50.0);  // it stands
constexpr double kNoise_rad = 1e-4;
constexpr std::int64_t kFrameUs = 100'000;

// A filter with stations that look at the target.
struct Watch {
  explicit Watch(std::vector<Vector3d> stations, const FilterConfig& config = {},
                 double start_sd_m = 100.0, const Vector3d& start_off_enu = Vector3d::Zero())
      : places(std::move(stations)),
        filter(config, kStart,
               {.p_ecef = site().to_ecef(kTarget + start_off_enu),
                .position_sd_m = start_sd_m,
                .velocity_sd_m_s = 20.0}) {}

  BearingUse look(std::size_t station, double off_rad = 0.0) {
    Ray ray = test::ray_to(std::string(1, static_cast<char>('a' + station)), places[station],
                           kTarget, kNoise_rad);
    ray = test::turned(ray, 0.0, off_rad);
    ray.sight.covariance_systematic =
        Eigen::Matrix2d::Identity() * declared_sd_rad * declared_sd_rad;
    return test::feed(filter, test::measurement_of(ray, now_us), errors);
  }
  // Frames of all stations; the first one's elevations are off by this.
  void look_all(int frames, double first_off_rad = 0.0) {
    for (int i = 0; i < frames; ++i, now_us += kFrameUs) {
      for (std::size_t k = 0; k < places.size(); ++k) look(k, k == 0 ? first_off_rad : 0.0);
    }
  }
  Solution judged() const { return judge_position(filter, filter.summary()); }

  std::vector<Vector3d> places;
  double declared_sd_rad = 0.0;
  BiasModel errors;
  TrackFilter filter;
  std::int64_t now_us = kStart;
};

std::vector<Vector3d> first_of_square(std::size_t count) {
  return {square().begin(), square().begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(PositionGuard, OneStationGivesNoPosition) {
  Watch watch(first_of_square(1));
  watch.look_all(10);
  EXPECT_EQ(watch.judged(), Solution::kTooFewRays);
}

TEST(PositionGuard, TwoStationsApartGiveOne) {
  Watch watch(first_of_square(2));
  watch.look_all(10);
  EXPECT_EQ(watch.judged(), Solution::kOk);
}

TEST(PositionGuard, ARangeIsKnownToAShareOfTheNearestStationsDistance) {
  Watch watch(first_of_square(2));
  watch.look_all(10);
  const KinematicState& state = watch.filter.summary();
  const double nearest_m = (site().to_ecef(kTarget) - site().to_ecef(watch.places[0])).norm();
  const Eigen::Matrix3d P = state.covariance.topLeftCorner<3, 3>();
  const double sd_m = std::sqrt(P.trace());  // between the largest of the axes and 1.8 times that
  EXPECT_TRUE(has_range(watch.filter, state, 1.01 * sd_m / nearest_m));
  EXPECT_FALSE(has_range(watch.filter, state, 0.55 * sd_m / nearest_m));
}

// What begins the track says where it is; the rays alone cross at 3.3 mrad.
TEST(PositionGuard, RaysThatCrossAtLessThanTheirUndeclaredErrorsGiveNone) {
  Watch silent({{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}}, {}, 10.0);
  silent.look_all(10);
  ASSERT_TRUE(has_range(silent.filter, silent.filter.summary(), FilterConfig{}.range_sd_limit));
  EXPECT_EQ(silent.judged(), Solution::kParallelRays);
  Watch declaring({{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}}, {}, 10.0);
  declaring.declared_sd_rad = 1e-5;
  declaring.look_all(10);
  EXPECT_EQ(declaring.judged(), Solution::kOk);
}

TEST(PositionGuard, WithoutARangeTheRaysAreParallelOrTooFew) {
  Watch watch({{-0.01, 0.0, 0.0}, {0.01, 0.0, 0.0}}, {}, 1000.0);
  watch.look_all(10);
  ASSERT_FALSE(has_range(watch.filter, watch.filter.summary(), FilterConfig{}.range_sd_limit));
  EXPECT_EQ(watch.judged(), Solution::kParallelRays);
  for (int i = 0; i < 15; ++i, watch.now_us += kFrameUs) watch.look(0);
  EXPECT_EQ(watch.judged(), Solution::kTooFewRays) << "the other one has been silent for a second";
}

TEST(PositionGuard, ATargetBeyondTheGreatestRangeIsTooFar) {
  FilterConfig config;
  const double nearest_m = (kTarget - square()[0]).norm();
  for (const double share : {0.99, 1.01}) {
    config.max_range_m = share * nearest_m;
    Watch watch({square()[1], square()[0]}, config);
    watch.look_all(20);
    EXPECT_EQ(watch.judged(), share < 1.0 ? Solution::kTooFar : Solution::kOk) << share;
  }
}

TEST(PositionGuard, AStationThatIsRejectedAgainAndAgainUnlessOthersOutvoteIt) {
  Watch watch(first_of_square(3));
  watch.look_all(20);
  ASSERT_EQ(watch.judged(), Solution::kOk);
  for (int i = 1; i <= kMaxConsecutiveRejections; ++i, watch.now_us += kFrameUs) {
    ASSERT_EQ(watch.look(0, i % 2 == 0 ? 0.3 : -0.3), BearingUse::kRejected);
    EXPECT_EQ(consecutive_rejections(watch.filter, watch.now_us), i);
    const bool miss = i == kMaxConsecutiveRejections;
    EXPECT_EQ(watch.judged(), miss ? Solution::kRaysMiss : Solution::kOk) << i;
  }
  EXPECT_EQ(consecutive_rejections(watch.filter, watch.now_us + 600'000), 0) << "silent since";
  ASSERT_EQ(watch.look(1), BearingUse::kUsed);
  EXPECT_EQ(watch.judged(), Solution::kRaysMiss) << "one against one";
  ASSERT_EQ(watch.look(2), BearingUse::kUsed);
  EXPECT_EQ(consecutive_rejections(watch.filter, watch.now_us), 0);
  EXPECT_EQ(watch.judged(), Solution::kOk);
}

// Two rays that miss each other by four times what their stations declare, and a third that says
// which of them is wrong. What begins the track is off, too, and leaves some bias.
TEST(PositionGuard, ATwoStationsMissBeyondWhatTheyDeclareIsAnInconsistentPair) {
  FilterConfig config;
  config.two_stations_nis = 8.0;
  const auto watched = [&](std::size_t stations, double off_rad) {
    Watch watch(first_of_square(stations), config, 30.0, {30.0, 0.0, 0.0});
    watch.declared_sd_rad = 1e-3;
    watch.look_all(60, off_rad);
    return watch;
  };
  EXPECT_FALSE(is_inconsistent_pair(watched(2, 0.0).filter));
  EXPECT_EQ(watched(2, 0.0).judged(), Solution::kOk);
  EXPECT_TRUE(is_inconsistent_pair(watched(2, 4e-3).filter));
  EXPECT_EQ(watched(2, 4e-3).judged(), Solution::kRaysMiss);
  EXPECT_FALSE(is_inconsistent_pair(watched(3, 4e-3).filter));
  config.two_stations_nis = 100.0;
  EXPECT_FALSE(is_inconsistent_pair(watched(2, 4e-3).filter));
}

TEST(PositionGuard, CountsTheStationsOfThisWindow) {
  Watch watch(first_of_square(3));
  watch.look_all(10);
  for (int i = 0; i < 10; ++i, watch.now_us += kFrameUs) {
    watch.look(0);
    if (i < 5) watch.look(1);
  }
  EXPECT_EQ(stations_lately(watch.filter, 0.3), 1);
  EXPECT_EQ(stations_lately(watch.filter, 0.7), 2);
  EXPECT_EQ(stations_lately(watch.filter, 2.0), 3);
}

}  // namespace
}  // namespace ols::fusion
