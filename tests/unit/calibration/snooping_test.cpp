#include "calibration/snooping.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numeric>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::hill;
using test::just_put_up;
using test::landmarks_around;
using test::rejected;

// The test's own promise: what is called detectable is found with 80 %, so that twice as much is
// found always but for noise, of which there is none here.
TEST(Snooping, FindsTwiceADetectableBias) {
  const StationModel truth = hill();
  Problem problem = landmarks_around(truth, just_put_up(), 7);
  const Adjustment clean(network_of(problem));
  const Calibration before = calibrate(clean);
  const double least_rad = before.tests[3].detectable_rad[0];
  ASSERT_TRUE(std::isfinite(least_rad));
  for (Observation& one : problem.observations) {
    if (one.reference == "landmark3") one.pixel.x() += 2.0 * least_rad * 13333.0;
  }
  const Adjustment biased(network_of(problem));
  EXPECT_EQ(rejected(biased, calibrate(biased)), std::vector<std::string>{"landmark3"});
}

// A round whose beginning is mistaken, each landmark by another angle: few sightings are asked for
// a heading, and the first of them are wrong.
TEST(Snooping, FindsTheHeadingThoughTheRoundBeginsMistaken) {
  const int count = 80, mistaken = 30;
  Problem problem = landmarks_around(hill(), just_put_up(), count);
  for (int i = 0; i < 2 * mistaken; ++i) {
    problem.observations[static_cast<std::size_t>(i)].reading.pan.counts += 2000.0 + 500.0 * i;
  }
  const Adjustment adjustment(network_of(problem));
  const Start start = find_start(adjustment, Levels{}.mistaken);
  EXPECT_NEAR(start.state.stations[0].model.geometry.chain.heading_rad,
              hill().geometry.chain.heading_rad, radians(0.05));
}

// What the linear tests foretell is what an adjustment without, or with, the group has.
TEST(Snooping, AStatisticIsTheChangeOfTheMisfit) {
  Problem problem = landmarks_around(hill(), hill(), 6);
  problem.observations[4].pixel.x() += 3.0;
  problem.observations[7].pixel.y() -= 2.0;
  const Adjustment adjustment(network_of(problem));
  const State start = adjustment.start({hill().geometry.chain.heading_rad});
  const Fit all = adjustment.fit(start, std::vector<bool>(6, true));
  std::vector<bool> others(6, true);
  others[2] = false;
  const Fit without = adjustment.fit(start, others);
  EXPECT_NEAR(test_statistic(adjustment, all, 2), all.misfit - without.misfit, 1e-3 * all.misfit);
  EXPECT_NEAR(test_statistic(adjustment, without, 2), all.misfit - without.misfit,
              1e-3 * all.misfit);
}

// Two sightings of six parameters whose units differ by six orders.
BlockEquations two_sightings(double phase) {
  Eigen::MatrixXd J(4, 6);
  Eigen::VectorXd v(4);
  for (int row = 0; row < 4; ++row) {
    v[row] = std::cos(phase + 3.0 * row);
    for (int column = 0; column < 6; ++column)
      J(row, column) = std::pow(10.0, column) *
                       std::sin((1.0 + phase) * (row + 1) * (column + 2) * (column + 2));
  }
  BlockEquations equations;
  equations.columns.resize(6);
  std::iota(equations.columns.begin(), equations.columns.end(), 0);
  equations.information = J.transpose() * J;
  equations.gradient = J.transpose() * v;
  equations.squares = v.squaredNorm();
  return equations;
}

TEST(Snooping, AReplacementIsTheChangeOfTheMisfit) {
  const BlockEquations now = two_sightings(0.3), then = two_sightings(1.1);
  const BlockEquations others = two_sightings(2.0), more = two_sightings(4.5);
  const Eigen::MatrixXd N = now.information + others.information + more.information;
  const Eigen::VectorXd scale = N.diagonal().cwiseSqrt().cwiseInverse();
  const auto inverse = [&scale](const Eigen::MatrixXd& M) -> Eigen::MatrixXd {
    const Eigen::MatrixXd scaled = scale.asDiagonal() * M * scale.asDiagonal();
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(6, 6);
    return scale.asDiagonal() * scaled.ldlt().solve(unit) * scale.asDiagonal();
  };
  Fit fit;
  fit.covariance = inverse(N);
  const Eigen::VectorXd g = now.gradient - then.gradient;
  const double expected =
      now.squares - then.squares + g.dot(inverse(N - now.information + then.information) * g);
  EXPECT_NEAR(replacement_statistic(fit, now, then), expected, 1e-6 * std::abs(expected));
}

}  // namespace
}  // namespace ols::calibration
