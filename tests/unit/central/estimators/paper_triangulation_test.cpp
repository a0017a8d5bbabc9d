#include "central/estimators/paper_triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;

PaperView view(const Vector3d& centre, const Vector3d& through, double belief = 1.0) {
  return {centre, (through - centre).normalized(), belief};
}

TEST(PaperTwoView, MeetsWhereExactRaysMeet) {
  const Vector3d target(30.0, 400.0, 50.0);
  const PaperPoint point = paper_two_view(view({-15, 0, 0}, target), view({15, 0, 0}, target));
  ASSERT_EQ(point.solution, Solution::kOk);
  EXPECT_LT((point.position_ecef - target).norm(), 1e-9);
}

// By hand: baseline 2 along x; both rays at 45 degrees towards each other in their own planes,
// which contain the x axis and are turned by +-0.1 rad about it. The common plane lies between, at
// a quarter of the angle from the plane of the view with three times the belief.
TEST(PaperTwoView, TurnsTheLessBelievedRayMore) {
  const double tilt = 0.1;
  const PaperView first{{-1, 0, 0}, Vector3d(1, std::cos(tilt), std::sin(tilt)).normalized(), 3.0};
  const PaperView second{
      {1, 0, 0}, Vector3d(-1, std::cos(tilt), -std::sin(tilt)).normalized(), 1.0};
  const PaperPoint point = paper_two_view(first, second);
  ASSERT_EQ(point.solution, Solution::kOk);
  const double angle = tilt - 0.25 * 2.0 * tilt;
  EXPECT_LT((point.position_ecef - Vector3d(0, std::cos(angle), std::sin(angle))).norm(), 1e-12);
}

TEST(PaperTwoView, EqualBeliefsGiveTheMidPlane) {
  const PaperView first{{-1, 0, 0}, Vector3d(1, 1, 0.2).normalized(), 0.4};
  const PaperView second{{1, 0, 0}, Vector3d(-1, 1, -0.2).normalized(), 0.4};
  const PaperPoint point = paper_two_view(first, second);
  ASSERT_EQ(point.solution, Solution::kOk);
  EXPECT_NEAR(point.position_ecef.z(), 0.0, 1e-12);
  EXPECT_NEAR(point.position_ecef.x(), 0.0, 1e-12);
}

TEST(PaperTwoView, NamesItsFailures) {
  const Vector3d a(0, 0, 0), b(10, 0, 0);
  const auto solution = [&](const Vector3d& u, const Vector3d& v, const Vector3d& second) {
    return paper_two_view({a, u.normalized(), 1.0}, {second, v.normalized(), 1.0}).solution;
  };
  EXPECT_EQ(solution({0, 1, 0}, {0, 1, 0}, b), Solution::kParallelRays);
  EXPECT_EQ(solution({0, 1, 0}, {0, 1, 0.1}, a), Solution::kParallelRays);  // one position
  EXPECT_EQ(solution({1, 0, 0}, {0, 1, 0}, b), Solution::kParallelRays);    // along the baseline
  EXPECT_EQ(solution({-1, 1, 0}, {1, 1, 0}, b), Solution::kBehindCamera);
  EXPECT_EQ(solution({0, 1, 0}, {-1.5e-5, 1, 0}, b), Solution::kParallelRays);
  PaperConfig near{.max_range_m = 50.0};
  EXPECT_EQ(
      paper_two_view({a, Vector3d(0, 1, 0), 1.0}, {b, Vector3d(-0.1, 1, 0).normalized(), 1.0}, near)
          .solution,
      Solution::kTooFar);
}

TEST(PaperNView, DoesNotOverflowAtThousandsOfMetres) {
  const Vector3d target(9000.0, 70000.0, 8000.0);
  const PaperPoint point = paper_n_view(
      {view({0, 0, 0}, target), view({5000, 0, 0}, target), view({2000, 6000, 10}, target)});
  ASSERT_EQ(point.solution, Solution::kOk);
  EXPECT_LT((point.position_ecef - target).norm(), 1e-5);
}

// Algorithm 1 written out for three views whose pairs intersect at different points.
TEST(PaperNView, WeighsPairsByTheirAngle) {
  const Vector3d target(0, 100, 0);
  std::vector<PaperView> views = {view({-10, 0, 0}, target), view({10, 0, 0}, target),
                                  view({0, 50, 0}, target + Vector3d(0.5, 0, 0.2))};
  Vector3d t[3] = {paper_two_view(views[0], views[1]).position_ecef,
                   paper_two_view(views[0], views[2]).position_ecef,
                   paper_two_view(views[1], views[2]).position_ecef};
  const Vector3d T0 = (t[0] + t[1] + t[2]) / 3.0;
  const Vector3d ends[3][2] = {
      {{-10, 0, 0}, {10, 0, 0}}, {{-10, 0, 0}, {0, 50, 0}}, {{10, 0, 0}, {0, 50, 0}}};
  Vector3d sum = Vector3d::Zero();
  double weights = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d line = (T0 - (ends[i][0] + ends[i][1]) / 2.0).normalized();
    const Vector3d along = (ends[i][1] - ends[i][0]).normalized();
    const double sine = line.cross(along).norm();  // = n_i . line
    weights += std::exp(sine);
    sum += std::exp(sine) * t[i];
  }
  const PaperPoint point = paper_n_view(views);
  ASSERT_EQ(point.solution, Solution::kOk);
  EXPECT_LT((point.position_ecef - sum / weights).norm(), 1e-9);
  EXPECT_GT((point.position_ecef - T0).norm(), 1e-4);
}

TEST(PaperNView, BestBaselineIsTheOneSquareToTheTarget) {
  const Vector3d target(0, 100, 0);
  std::vector<PaperView> views = {view({-10, 0, 0}, target), view({10, 0, 0}, target),
                                  view({0, 50, 0}, target + Vector3d(0.5, 0, 0.2))};
  const PaperPoint best = paper_n_view(views, {.pairs = PaperPairs::kBestBaseline});
  ASSERT_EQ(best.solution, Solution::kOk);
  EXPECT_LT((best.position_ecef - target).norm(), 1e-9);
}

TEST(PaperNView, EachPartIsSwitchedAlone) {
  const Vector3d target(0, 100, 0);
  std::vector<PaperView> views = {view({-10, 0, 0}, target), view({10, 0, 0}, target),
                                  view({0, 50, 0}, target + Vector3d(0.5, 0, 0.2))};
  views[2].belief = 0.2;
  const auto point = [&](const PaperConfig& config) {
    return paper_n_view(views, config).position_ecef;
  };
  const Vector3d centroid = point({.pairs = PaperPairs::kCentroid});
  const Vector3d pairs = paper_two_view(views[0], views[1]).position_ecef +
                         paper_two_view(views[0], views[2]).position_ecef +
                         paper_two_view(views[1], views[2]).position_ecef;
  EXPECT_LT((centroid - pairs / 3.0).norm(), 1e-9);
  EXPECT_GT((centroid - point({})).norm(), 1e-4);
  const Vector3d halves = point({.pairs = PaperPairs::kCentroid, .by_belief = false});
  EXPECT_GT((halves - centroid).norm(), 1e-3);
  for (PaperView& each : views) each.belief = 0.5;
  EXPECT_LT((halves - point({.pairs = PaperPairs::kCentroid})).norm(), 1e-9);
}

TEST(PaperEstimate, CovarianceIsThatOfTheLeastSquaresForOneSymmetricPair) {
  const std::vector<Eigen::Vector3d> places = {{-50, 0, 0}, {50, 0, 0}};
  const auto rays = test::rays_from(places, {0, 200, 0}, 1e-3);
  const Estimate estimate = paper_estimate(rays);
  ASSERT_EQ(estimate.solution, Solution::kOk);
  const Eigen::Matrix3d R = test::site().R_ecef_enu();
  const Eigen::Matrix3d covariance = R.transpose() * estimate.covariance_ecef * R;
  // By hand: range r, half crossing angle t: along sigma r / (sqrt 2 sin t), across / cos t.
  const double r = std::hypot(200.0, 50.0);
  EXPECT_NEAR(std::sqrt(covariance(1, 1)), 1e-3 * r / (std::sqrt(2.0) * (50.0 / r)), 1e-2);
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), 1e-3 * r / (std::sqrt(2.0) * (200.0 / r)), 1e-2);
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), 1e-3 * r / std::sqrt(2.0), 1e-2);
}

TEST(MovingAverage, IsTheMeanOfTheLastTen) {
  MovingAverage average(10, 0.3);
  Estimate last;
  for (int i = 0; i < 25; ++i) {
    Estimate estimate;
    estimate.solution = Solution::kOk;
    estimate.position_ecef = Eigen::Vector3d(i, 0, 0);
    estimate.covariance_white_ecef = Eigen::Matrix3d::Identity();
    estimate.covariance_ecef = 3.0 * Eigen::Matrix3d::Identity();
    last = average.add(estimate, 1'000'000 * i);
  }
  EXPECT_NEAR(last.position_ecef.x(), (15 + 24) / 2.0, 1e-12);
  EXPECT_NEAR(last.covariance_white_ecef(1, 1), 0.1, 1e-12);
  EXPECT_NEAR(last.covariance_ecef(1, 1), 2.0 + 0.1, 1e-12);
  EXPECT_NEAR(last.covariance_ecef(0, 0), 2.0 + 0.1 + 4.5 * 4.5, 1e-12);  // lag of 4.5
}

// The mean of two estimates from the same bearings is no better than either.
TEST(MovingAverage, CountsWhatWindowsShareOnce) {
  Estimate estimate;
  estimate.solution = Solution::kOk;
  estimate.position_ecef.setZero();
  estimate.covariance_white_ecef = estimate.covariance_ecef = Eigen::Matrix3d::Identity();
  const auto of_two = [&](std::int64_t apart_us) {
    MovingAverage average(10, 0.3);
    average.add(estimate, 0);
    return average.add(estimate, apart_us).covariance_white_ecef(0, 0);
  };
  EXPECT_NEAR(of_two(0), 1.0, 1e-12);
  EXPECT_NEAR(of_two(150'000), 0.75, 1e-12);
  EXPECT_NEAR(of_two(300'000), 0.5, 1e-12);
}

}  // namespace
}  // namespace ols::fusion
