#include "edge/calibration/view_offset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/moved_scene.h"

namespace ols::station {
namespace {

constexpr double kSd_rad = 2.4e-5;

TEST(ViewOffset, AShiftToTheRightIsATurnToTheLeft) {
  const StationGeometry geometry;
  const PanTilt at{0.5, 0.1};
  const auto offset =
      offset_of({moved_scene(1, 0.0, 0.0), at}, {moved_scene(1, 3.0, 2.0), at}, geometry, kSd_rad);
  ASSERT_TRUE(offset);
  const double pixel_rad = 1.0 / geometry.camera.fx_px;
  EXPECT_NEAR(offset->left_rad, 3.0 * pixel_rad, 0.1 * pixel_rad);
  EXPECT_NEAR(offset->up_rad, 2.0 * pixel_rad, 0.1 * pixel_rad);
  EXPECT_EQ(offset->shafts.pan_rad, 0.5);
  EXPECT_GE(offset->sd_rad, kSd_rad);
}

TEST(ViewOffset, CountsThatDifferAreNoTurn) {
  const StationGeometry geometry;
  const double pixel_rad = 1.0 / geometry.camera.fx_px;
  const PanTilt stored{0.5, 0.3};
  const PanTilt seen{0.5 + 4.0 * pixel_rad / std::cos(0.3), 0.3 + 2.0 * pixel_rad};
  const auto offset = offset_of({moved_scene(1, 0.0, 0.0), stored},
                                {moved_scene(1, 4.0, 2.0), seen}, geometry, kSd_rad);
  ASSERT_TRUE(offset);
  EXPECT_NEAR(offset->left_rad, 0.0, 0.1 * pixel_rad);
  EXPECT_NEAR(offset->up_rad, 0.0, 0.1 * pixel_rad);
}

TEST(ViewOffset, AnotherSceneIsNone) {
  EXPECT_FALSE(
      offset_of({moved_scene(1, 0.0, 0.0), {}}, {moved_scene(2, 0.0, 0.0), {}}, {}, kSd_rad));
}

}  // namespace
}  // namespace ols::station
