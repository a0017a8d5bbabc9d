#include "calibration/adjustment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "calibration/snooping.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::hill;
using test::landmarks_around;

TEST(Adjustment, WithoutErrorsNothingIsLeftOver) {
  const Adjustment adjustment(network_of(landmarks_around(hill(), hill(), 5)));
  State start = adjustment.start({hill().geometry.chain.heading_rad + radians(1.0)});
  const Fit fit = adjustment.fit(start, std::vector<bool>(5, true));
  EXPECT_TRUE(fit.converged);
  EXPECT_LT(fit.misfit, 1e-4);
  EXPECT_NEAR(fit.state.stations[0].model.geometry.chain.heading_rad,
              hill().geometry.chain.heading_rad, 0.1 * test::kArcsec);
}

TEST(Adjustment, WhatIsKnownExactlyStays) {
  Problem problem = landmarks_around(hill(), hill(), 4);
  problem.stations[0].covariance(kFocal, kFocal) = 0.0;
  problem.observations[0].pixel.x() += 5.0;
  const Adjustment adjustment(network_of(problem));
  const Fit fit = adjustment.fit(adjustment.start({hill().geometry.chain.heading_rad}),
                                 std::vector<bool>(4, true));
  EXPECT_EQ(fit.state.stations[0].model.geometry.camera.fx_px, hill().geometry.camera.fx_px);
  EXPECT_EQ(fit.covariance(kFocal, kFocal), 0.0);
}

// Scenery of which much is matched wrongly: each step moves what the weights hold back, and gains
// less than the one before.
TEST(Adjustment, FollowsRobustWeightsThatCreepToTheirEnd) {
  std::mt19937_64 random(1);
  std::cauchy_distribution<double> wrong;
  Problem problem = test::landmarks_around(test::crooked(), test::just_put_up(), 7);
  for (Observation& one : test::scenery_around(test::crooked(), 24).observations) {
    const double y = std::clamp(wrong(random), -40.0, 40.0);
    const double x = std::clamp(wrong(random), -40.0, 40.0);
    one.pixel += 0.3 * Eigen::Vector2d(x, y);
    problem.observations.push_back(one);
  }
  const Adjustment adjustment(network_of(problem));
  const Start start = find_start(adjustment, Levels{}.mistaken);
  EXPECT_TRUE(adjustment.fit(start.state, start.kept).converged);
}

}  // namespace
}  // namespace ols::calibration
