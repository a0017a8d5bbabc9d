#include "calibration/snooping.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace ols::calibration
