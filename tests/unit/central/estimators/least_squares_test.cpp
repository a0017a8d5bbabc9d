#include "central/estimators/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::ray_to;
using test::rays_from;
using test::site;
using test::square;
using test::turned;

TEST(LeastSquares, ExactRaysMeetFromTenMetresToTwoHundredKilometres) {
  for (const double scale : {0.02, 1.0, 50.0, 400.0}) {
    std::vector<Vector3d> places;
    for (const Vector3d& place : square()) places.push_back(place * scale);
    const Vector3d target = Vector3d(120.0, 350.0, 200.0) * scale;
    const Estimate estimate = least_squares(rays_from(places, target));
    ASSERT_EQ(estimate.solution, Solution::kOk) << scale;
    EXPECT_LT((estimate.position_ecef - site().to_ecef(target)).norm(), 1e-8 * (1.0 + scale));
    EXPECT_LT(estimate.residual, 1e-5);
  }
}

// By hand: two rays of equal noise sigma at range r, crossing at 2t: see the paper's section 4.
TEST(LeastSquares, CovarianceOfASymmetricPair) {
  const double sigma = 1e-4;
  const Estimate estimate = least_squares(rays_from({{-50, 0, 0}, {50, 0, 0}}, {0, 200, 0}, sigma));
  ASSERT_EQ(estimate.solution, Solution::kOk);
  const Eigen::Matrix3d R = site().R_ecef_enu();
  const Eigen::Matrix3d covariance = R.transpose() * estimate.covariance_ecef * R;
  const double r = std::hypot(200.0, 50.0);
  EXPECT_NEAR(std::sqrt(covariance(1, 1)), sigma * r / (std::sqrt(2.0) * (50.0 / r)), 1e-4);
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), sigma * r / (std::sqrt(2.0) * (200.0 / r)), 1e-4);
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), sigma * r / std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(estimate.crossing_angle_rad, 2.0 * std::atan2(50.0, 200.0), 1e-9);
}

TEST(LeastSquares, SystematicPartsEnterOnlyTheTotal) {
  auto rays = rays_from(square(), {50, 80, 120});
  const Estimate white = least_squares(rays);
  for (Ray& ray : rays) {
    ray.sight.covariance_systematic = 3.0 * ray.sight.covariance_white;
  }
  const Estimate both = least_squares(rays);
  EXPECT_LT((both.covariance_white_ecef - white.covariance_ecef).norm(),
            1e-6 * white.covariance_ecef.norm());
  EXPECT_LT((both.covariance_ecef - 4.0 * white.covariance_ecef).norm(),
            1e-6 * both.covariance_ecef.norm());
}

TEST(LeastSquares, ClockErrorCountsAlongTheMotionOnly) {
  Ray ray = ray_to("a", {0, 0, 0}, {0, 100, 0});
  ray.rate_rad_s = {0.5, 0.0};
  ray.clock_sd_s = 0.01;
  ray.sight.origin_sd_enu_m = {0.0, 2.0, 1.0};
  const Eigen::Matrix2d covariance = systematic_covariance(ray, 100.0);
  EXPECT_NEAR(covariance(0, 0), 0.005 * 0.005, 1e-12);  // north error: along the ray
  EXPECT_NEAR(covariance(1, 1), 0.01 * 0.01, 1e-9);     // up error over the range
}

TEST(LeastSquares, DoesNotDependOnTheOrderOfStations) {
  auto rays = rays_from(square(), {50, 80, 120});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i] = turned(rays[i], 1e-4 * static_cast<double>(i), -5e-5 * static_cast<double>(i));
  }
  const Estimate first = least_squares(rays);
  std::ranges::reverse(rays);
  const Estimate second = least_squares(rays);
  ASSERT_EQ(first.solution, Solution::kOk);
  EXPECT_LT((first.position_ecef - second.position_ecef).norm(), 1e-8);
}

// One grossly wrong ray of three or more is rejected; the result of the others is unaffected.
TEST(LeastSquares, SetsOneBadRayAside) {
  const Vector3d target(50, 80, 120);
  for (const std::size_t stations : {std::size_t{3}, std::size_t{4}}) {
    for (std::size_t bad = 0; bad < stations; ++bad) {
      auto rays =
          rays_from({square().begin(), square().begin() + static_cast<long>(stations)}, target);
      rays[bad] = turned(rays[bad], 0.03, 0.05);
      const Estimate estimate = least_squares(rays);
      ASSERT_EQ(estimate.solution, Solution::kOk) << stations << " " << bad;
      EXPECT_FALSE(estimate.rays[bad].used);
      EXPECT_GT(estimate.rays[bad].squared, 1e4);
      EXPECT_LT((estimate.position_ecef - site().to_ecef(target)).norm(), 1e-6);
    }
  }
}

// Two of four rays pass the target ten metres away: no three of the four agree.
TEST(LeastSquares, WhereNoSubsetAgreesTheWorstRaysCountLeast) {
  const Vector3d target(50, 80, 120);
  auto rays = rays_from(square(), target);
  rays[0] = turned(rays[0], 0.03, 0.0);
  rays[1] = turned(rays[1], 0.0, 0.05);
  const Estimate estimate = least_squares(rays);
  ASSERT_EQ(estimate.solution, Solution::kOk);
  EXPECT_LT((estimate.position_ecef - site().to_ecef(target)).norm(), 3.0);
}

TEST(LeastSquares, TwoRaysThatMissEachOtherAreHonestAboutIt) {
  auto rays = rays_from({square()[0], square()[1]}, {50, 80, 120});
  const Estimate good = least_squares(rays);
  rays[0] = turned(rays[0], 0.0, 0.01);
  const Estimate missing = least_squares(rays);
  ASSERT_EQ(missing.solution, Solution::kOk);
  EXPECT_GT(missing.residual, 10.0);
  const double error_m = (missing.position_ecef - good.position_ecef).norm();
  EXPECT_GT(3.0 * std::sqrt(missing.covariance_ecef.trace()), error_m);
}

TEST(LeastSquares, NamesItsFailures) {
  EXPECT_EQ(least_squares({}).solution, Solution::kTooFewRays);
  EXPECT_EQ(least_squares(rays_from({{0, 0, 0}}, {0, 100, 0})).solution, Solution::kTooFewRays);
  // Parallel, at one place, and a crossing angle below what these sigmas resolve.
  const std::vector<Ray> parallel = {ray_to("a", {0, 0, 0}, {0, 1e9, 0}),
                                     ray_to("b", {10, 0, 0}, {10, 1e9, 0})};
  EXPECT_EQ(least_squares(parallel).solution, Solution::kParallelRays);
  EXPECT_EQ(least_squares(rays_from({{0, 0, 0}, {0, 0, 0}}, {0, 100, 0})).solution,
            Solution::kParallelRays);
  EXPECT_EQ(least_squares(rays_from({{0, 0, 0}, {0.5, 0, 0}}, {0, 2000, 0})).solution,
            Solution::kParallelRays);
  EXPECT_EQ(least_squares(rays_from({{0, 0, 0}, {0.5, 0, 0}}, {0, 2000, 0}, 1e-6)).solution,
            Solution::kOk);
  // Rays that diverge.
  const std::vector<Ray> diverging = {ray_to("a", {-50, 0, 0}, {-100, 100, 0}),
                                      ray_to("b", {50, 0, 0}, {100, 100, 0})};
  EXPECT_EQ(least_squares(diverging).solution, Solution::kBehindCamera);
  // The better one passes behind the camera of the other, to which every step comes nearer.
  const auto along = [](const char* name, const Vector3d& from, double azimuth, double elevation,
                        double sigma) {
    return ray_to(name, from, from + 100.0 * enu_from_azimuth_elevation({azimuth, elevation}),
                  sigma);
  };
  const std::vector<Ray> skew = {along("a", {87.6, -6.9, 0.3}, 4.053, 0.047, 0.036),
                                 along("b", {5.7, 46.6, -4.2}, 1.452, 0.934, 0.0032)};
  EXPECT_EQ(least_squares(skew).solution, Solution::kBehindCamera);
  LeastSquaresConfig near;
  near.max_range_m = 100.0;
  EXPECT_EQ(least_squares(rays_from(square(), {0, 500, 0}), near).solution, Solution::kTooFar);
}

TEST(Velocity, FollowsFromTheRates) {
  auto rays = rays_from(square(), {50, 80, 120});
  const Vector3d velocity(12.0, -7.0, 3.0);
  for (Ray& ray : rays) {
    const Vector3d before = site().to_enu(ray.sight.origin_ecef);
    const Ray later = ray_to("", before, Vector3d(50, 80, 120) + velocity * 1e-4);
    const RayFrame frame = ray_frame(ray.sight);
    ray.rate_rad_s = frame.tangent.transpose() * direction_ecef(later.sight) / 1e-4;
  }
  Estimate estimate = least_squares(rays);
  estimate_velocity(rays, estimate);
  const Vector3d found = site().R_ecef_enu().transpose() * estimate.velocity_ecef;
  EXPECT_LT((found - velocity).norm(), 1e-3);
  EXPECT_GT(estimate.velocity_covariance_ecef.trace(), 0.0);
}

// Error and covariance over many trials: the mean normalised error squared per axis is 1, the RMS
// error is the Cramer-Rao bound.
TEST(LeastSquares, IsConsistentAndEfficient) {
  constexpr unsigned kSeed = 20240501;
  constexpr int kTrials = 4000;
  RecordProperty("seed", kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  const Vector3d target(50, 80, 120);
  auto truth = rays_from(square(), target);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double scale = 1.0 + static_cast<double>(i);
    truth[i].sight.covariance_white << 4e-8 * scale, 1e-8, 1e-8, 2e-8;
    truth[i].sight.covariance_systematic << 1e-8, 0, 0, 3e-8;
  }
  // The bound from the rays' geometry at the truth, written out here.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const Ray& ray : truth) {
    const RayFrame frame = ray_frame(ray.sight);
    const double range_m = (site().to_ecef(target) - ray.sight.origin_ecef).norm();
    const Eigen::Matrix2d R = ray.sight.covariance_white + ray.sight.covariance_systematic;
    information += frame.tangent * R.inverse() * frame.tangent.transpose() / (range_m * range_m);
  }
  const double bound_m2 = information.inverse().trace();
  double nees = 0.0, squared_m2 = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    auto rays = truth;
    for (Ray& ray : rays) {
      const Eigen::Matrix2d R = ray.sight.covariance_white + ray.sight.covariance_systematic;
      const Eigen::Vector2d error =
          R.llt().matrixL() * Eigen::Vector2d(normal(random), normal(random));
      ray = turned(ray, error.x(), error.y());
    }
    const Estimate estimate = least_squares(rays);
    ASSERT_EQ(estimate.solution, Solution::kOk);
    const Vector3d error = estimate.position_ecef - site().to_ecef(target);
    nees += error.dot(estimate.covariance_ecef.inverse() * error) / (3.0 * kTrials);
    squared_m2 += error.squaredNorm() / kTrials;
  }
  EXPECT_GT(nees, 0.9) << "seed " << kSeed;
  EXPECT_LT(nees, 1.1) << "seed " << kSeed;
  EXPECT_LT(std::sqrt(squared_m2 / bound_m2), 1.05);
  EXPECT_GT(std::sqrt(squared_m2 / bound_m2), 0.95);
}

}  // namespace
}  // namespace ols::fusion
