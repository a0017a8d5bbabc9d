#include "central/estimators/alignment.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <random>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::measurement_of;
using test::ray_to;
using test::site;

constexpr std::int64_t kEpoch = 1'700'000'000'000'000;
using Path = std::function<Vector3d(double)>;

Vector3d straight(double t_s) { return {30.0 + 20.0 * t_s, 250.0 - 10.0 * t_s, 60.0 + 3.0 * t_s}; }
// 60 m radius at 15 m/s: 3.75 m/s^2 of centripetal acceleration.
Vector3d circle(double t_s) {
  return {60.0 * std::sin(0.25 * t_s), 250.0 + 60.0 * std::cos(0.25 * t_s), 60.0};
}

std::vector<BearingMeasurement> seen(const Path& path, const std::vector<double>& times_s,
                                     double sigma_rad = 1e-4) {
  std::vector<BearingMeasurement> measurements;
  for (const double t_s : times_s) {
    measurements.push_back(measurement_of(ray_to("a", {0, 0, 0}, path(t_s), sigma_rad),
                                          kEpoch + std::llround(t_s * 1e6)));
  }
  return measurements;
}

std::vector<double> frames(double from_s, double to_s, double rate_hz) {
  std::vector<double> times;
  for (double t = from_s; t <= to_s; t += 1.0 / rate_hz) times.push_back(t);
  return times;
}

// Angle between the ray and the true direction at the epoch.
double miss_rad(const Ray& ray, const Path& path) {
  const Vector3d truth = site().to_ecef(path(0.0)) - ray.sight.origin_ecef;
  return angle_between(direction_ecef(ray.sight), truth);
}

TEST(Alignment, GivesNoRayThatIsNotFinite) {
  for (const double sigma_rad : {1e-160, 1e160}) {
    EXPECT_FALSE(align(seen(straight, frames(-0.5, 0.0, 30.0), sigma_rad), kEpoch, 250.0));
  }
}

TEST(Alignment, InterpolatesAndExtrapolatesStraightMotion) {
  // Whole window before the epoch, across it, and 66 ms beyond the last bearing.
  for (const double last_s : {0.0, 0.2, -0.066}) {
    const auto ray = align(seen(straight, frames(-0.5, last_s, 30.0)), kEpoch, 250.0);
    ASSERT_TRUE(ray);
    EXPECT_LT(miss_rad(*ray, straight), 2e-5) << last_s;
    EXPECT_LT(ray->sight.covariance_white.trace(), 2.0 * 4e-8) << last_s;
  }
}

TEST(Alignment, FollowsCurvedMotion) {
  for (const double last_s : {0.0, 0.2, -0.05}) {
    const auto ray = align(seen(circle, frames(-0.5, last_s, 15.0)), kEpoch, 310.0);
    ASSERT_TRUE(ray);
    EXPECT_LT(miss_rad(*ray, circle), 1e-4) << last_s;
    const double sd_rad = std::sqrt(ray->sight.covariance_white.trace());
    EXPECT_LT(miss_rad(*ray, circle), 2.0 * sd_rad) << last_s;
  }
}

TEST(Alignment, KnowsTheRate) {
  const auto ray = align(seen(straight, frames(-0.4, 0.4, 30.0), 1e-6), kEpoch, 250.0);
  ASSERT_TRUE(ray);
  const Vector3d line = site().to_ecef(straight(0.0)) - ray->sight.origin_ecef;
  const Vector3d velocity =
      (site().to_ecef(straight(1e-3)) - site().to_ecef(straight(-1e-3))) / 2e-3;
  const Eigen::Vector2d expected =
      ray_frame(ray->sight).tangent.transpose() * velocity / line.norm();
  EXPECT_LT((ray->rate_rad_s - expected).norm(), 1e-3 * expected.norm());
}

TEST(Alignment, ASingleBearingIsItselfAtItsInstantAndVagueElsewhere) {
  const auto bearing = seen(straight, {0.0});
  const auto at = align(bearing, kEpoch, 250.0);
  ASSERT_TRUE(at);
  EXPECT_LT(miss_rad(*at, straight), 1e-12);
  EXPECT_NEAR(at->sight.covariance_white.trace(), 2e-8, 1e-12);
  const auto later = align(bearing, kEpoch + 100'000, 250.0);
  ASSERT_TRUE(later);
  EXPECT_GT(later->sight.covariance_white.trace(), 1e-2);  // 0.1 s of an unknown rate
  EXPECT_NEAR(later->age_s, 0.1, 1e-9);
}

TEST(Alignment, NoRayFarFromAllBearings) {
  EXPECT_FALSE(align({}, kEpoch, 250.0));
  EXPECT_FALSE(align(seen(straight, {-0.7, -0.6, -0.5}), kEpoch, 250.0));
  // A gap with the epoch in its middle.
  EXPECT_FALSE(align(seen(straight, {-0.6, -0.5, 0.5, 0.6}), kEpoch, 250.0));
}

TEST(Alignment, LeavesWhatStaysAsItIs) {
  auto measurements = seen(straight, frames(-0.3, 0.0, 30.0));
  for (BearingMeasurement& measurement : measurements) {
    measurement.sight.covariance_systematic << 3e-8, 1e-8, 1e-8, 2e-8;
    measurement.sight.origin_sd_enu_m = {1, 2, 3};
    measurement.clock_sd_s = 0.002;
    measurement.belief = 0.8;
  }
  const auto ray = align(measurements, kEpoch, 250.0);
  ASSERT_TRUE(ray);
  EXPECT_EQ(ray->sight.covariance_systematic, measurements[0].sight.covariance_systematic);
  EXPECT_EQ(ray->sight.origin_sd_enu_m, Vector3d(1, 2, 3));
  EXPECT_EQ(ray->clock_sd_s, 0.002);
  EXPECT_NEAR(ray->belief, 0.8, 1e-12);
}

// A lever arm: the camera centre moves while the PTU turns.
TEST(Alignment, TheCameraCentreMovesAlong) {
  const auto centre = [](double t_s) { return Vector3d(0.1 * t_s, 0.05 * t_s, 0.0); };
  std::vector<BearingMeasurement> measurements;
  for (const double t_s : frames(-0.4, -0.05, 30.0)) {
    measurements.push_back(
        measurement_of(ray_to("a", centre(t_s), straight(t_s)), kEpoch + std::llround(t_s * 1e6)));
  }
  const auto ray = align(measurements, kEpoch, 250.0);
  ASSERT_TRUE(ray);
  EXPECT_LT((ray->sight.origin_ecef - site().to_ecef(centre(0.0))).norm(), 1e-3);
}

TEST(Alignment, WorksOverTheZenith) {
  const Path over = [](double t_s) { return Vector3d(20.0 * t_s, 1.0, 100.0); };
  const auto ray = align(seen(over, frames(-0.3, 0.3, 30.0)), kEpoch, 100.0);
  ASSERT_TRUE(ray);
  EXPECT_LT(miss_rad(*ray, over), 5e-5);
}

// The covariance covers noise and unmodelled acceleration together: over many random flights the
// mean normalised error squared is about 1, whether the epoch lies between or beyond the bearings.
TEST(Alignment, CovarianceIsConsistent) {
  constexpr unsigned kSeed = 5;
  constexpr int kTrials = 3000;
  for (const double last_s : {0.0, 0.2, -0.06}) {
    std::mt19937_64 random(kSeed);
    std::normal_distribution<double> normal;
    double nees = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const Vector3d velocity = 10.0 * Vector3d(normal(random), normal(random), normal(random));
      const Vector3d acceleration = 5.0 * Vector3d(normal(random), normal(random), normal(random));
      const Path path = [&](double t_s) {
        return Vector3d(Vector3d(50, 250, 60) + velocity * t_s + acceleration * (t_s * t_s / 2.0));
      };
      auto measurements = seen(path, frames(-0.4, last_s, 15.0));
      for (BearingMeasurement& measurement : measurements) {
        Ray ray;
        ray.sight = measurement.sight;
        measurement.sight = test::turned(ray, 1e-4 * normal(random), 1e-4 * normal(random)).sight;
      }
      const auto ray = align(measurements, kEpoch, 262.0);
      ASSERT_TRUE(ray);
      const RayFrame frame = ray_frame(ray->sight);
      const Vector3d truth = site().to_ecef(path(0.0)) - ray->sight.origin_ecef;
      const Eigen::Vector2d error = frame.tangent.transpose() * truth / frame.direction.dot(truth);
      nees += error.dot(ray->sight.covariance_white.inverse() * error) / (2.0 * kTrials);
    }
    EXPECT_GT(nees, 0.8) << "last bearing at " << last_s << ", seed " << kSeed;
    EXPECT_LT(nees, 1.25) << "last bearing at " << last_s << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace ols::fusion
