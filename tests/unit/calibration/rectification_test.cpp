#include "calibration/rectification.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::kArcsec;

// A level line through the picture of a camera that is rolled by what its mounting says.
Problem rolled(double roll_rad) {
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {test::prior_of(test::hill())};
  problem.stations[0].covariance(kTiltX, kTiltX) = problem.stations[0].covariance(kTiltY, kTiltY) =
      std::pow(41.0 * kArcsec, 2);
  for (const double y : {200.0, 480.0, 760.0}) {
    Observation one;
    one.kind = Kind::kLevelLine;
    one.reference = "board";
    one.sd_px = 0.1;
    one.target.sd = 30.0 * kArcsec;
    one.pixel = {240.0, y + 400.0 * std::tan(roll_rad)};
    one.target.second_px = {1040.0, y - 400.0 * std::tan(roll_rad)};
    problem.observations.push_back(one);
  }
  return problem;
}

TEST(RectifiedAngles, TheRollIsKnownAsWellAsTheLineIsLevel) {
  const Problem problem = rolled(0.004);
  const Adjustment adjustment(network_of(problem));
  const Calibration found = calibrate(adjustment);
  EXPECT_FALSE(found.headings_known);
  EXPECT_EQ(found.remarks.size(), 1U);
  const auto angles = rectified_angles(problem, adjustment, found, 0);
  ASSERT_EQ(angles.size(), 1U);
  EXPECT_STREQ(to_string(angles[0].kind), "roll");
  EXPECT_NEAR(angles[0].rad, 0.004, 10.0 * kArcsec);
  EXPECT_NEAR(angles[0].sd_rad / kArcsec, 36.6, 2.0);
  // The tripod's own level stands between the horizon and the mounting.
  const int roll = adjustment.network().layout.station(0) + kMountX;
  EXPECT_NEAR(std::sqrt(found.fit.covariance(roll, roll)) / kArcsec, 80.0, 15.0);
}

TEST(RectifiedAngles, NoTargetNoAngle) {
  const Problem problem = test::landmarks_around(test::hill(), test::hill(), 5);
  const Adjustment adjustment(network_of(problem));
  const Calibration found = calibrate(adjustment);
  EXPECT_TRUE(found.headings_known);
  EXPECT_TRUE(rectified_angles(problem, adjustment, found, 0).empty());
}

}  // namespace
}  // namespace ols::calibration
