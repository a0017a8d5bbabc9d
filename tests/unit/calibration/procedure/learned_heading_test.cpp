#include "calibration/procedure/learned_heading.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

TEST(LearnedHeading, OneSightingTellsIt) {
  const StationModel truth = test::hill();
  const Observation one = test::landmark(35.0, 12.0, "mast");
  const Eigen::Vector3d place = test::place_seen(truth, one, 700.0, 0.0).ecef;
  StationModel believed = truth;
  believed.geometry.chain.heading_rad = radians(310.0);
  const auto heading = learned_heading(believed, one.reading, one.pixel, place);
  ASSERT_TRUE(heading);
  // The camera stands elsewhere by its lever arms, at the heading that was believed.
  EXPECT_NEAR(*heading, truth.geometry.chain.heading_rad, 0.15 / 700.0);
}

}  // namespace
}  // namespace ols::calibration
