#include "edge/frames/image_turn.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/sight.h"

namespace ols::station {
namespace {

StationGeometry geometry() {
  StationGeometry geometry;
  geometry.chain.heading_rad = radians(30.0);
  geometry.chain.mount_x_rad = radians(3.0);
  geometry.chain.mount_y_rad = radians(-2.0);
  geometry.chain.tilt_sign = -1;
  return geometry;
}

TEST(ImageTurn, IsTheTurnThatMovesThePicture) {
  const StationGeometry station = geometry();
  const PanTilt from{radians(20.0), radians(-35.0)}, to{radians(21.0), radians(-35.4)};
  for (const Eigen::Vector2d& middle : {Eigen::Vector2d(640, 480), Eigen::Vector2d(200, 900)}) {
    const auto found = image_turn(station.chain, station.camera, from,
                                  {rotation_homography(station, from, to), middle, 0.1});
    ASSERT_TRUE(found);
    EXPECT_NEAR(degrees(found->turn.pan_rad), 1.0, 1e-6);
    EXPECT_NEAR(degrees(found->turn.tilt_rad), -0.4, 1e-6);
    EXPECT_NEAR(found->sd.tilt_rad, 0.1 / station.camera.fx_px, 1e-6);
    EXPECT_GT(found->sd.pan_rad, 1.1 * found->sd.tilt_rad) << "pan turns less of a raised view";
  }
}

TEST(ImageTurn, GoesTheShortWayRound) {
  const StationGeometry station = geometry();
  const PanTilt from{radians(179.8), 0.0}, to{radians(180.3), 0.0};
  const auto found =
      image_turn(station.chain, station.camera, from,
                 {rotation_homography(station, from, to), Eigen::Vector2d(640, 480), 0.1});
  ASSERT_TRUE(found);
  EXPECT_NEAR(degrees(found->turn.pan_rad), 0.5, 1e-6);
}

TEST(ImageTurn, SaysNothingBeyondTheVertical) {
  const StationGeometry station = geometry();
  EXPECT_FALSE(image_turn(station.chain, station.camera, {0.0, radians(-120.0)},
                          {Eigen::Matrix3d::Identity(), Eigen::Vector2d(640, 480), 0.1}));
}

}  // namespace
}  // namespace ols::station
