#include "edge/detector/tracklet.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "edge/detector/detection.h"

namespace ols::detector {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;

Detection spot(double x, double y) {
  return {{x, y}, {3.0, 3.0}, 10.0, true, Evidence::kSpot, true};
}

Eigen::Matrix3d shift(double x_px) {
  Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
  motion(0, 2) = x_px;
  return motion;
}

TEST(Tracklet, LearnsItsVelocity) {
  Tracklet tracklet(1, spot(100.0, 50.0), 640.0);
  for (int i = 1; i <= 30; ++i) {
    tracklet.predict(shift(0.0), kFrame_s);
    tracklet.update(spot(100.0 + 3.0 * i, 50.0));
  }
  EXPECT_NEAR(tracklet.velocity_px_s().x(), 90.0, 3.0);
  EXPECT_NEAR(tracklet.way_px(), 90.0, 2.0);
  EXPECT_FALSE(tracklet.rests());
}

TEST(Tracklet, RestsRelativeToTheSceneWhileTheCameraTurns) {
  Tracklet tracklet(1, spot(100.0, 50.0), 640.0);
  for (int i = 1; i <= 100; ++i) {
    tracklet.predict(shift(2.0), kFrame_s);
    tracklet.update(spot(100.0 + 2.0 * i, 50.0));
  }
  EXPECT_NEAR(tracklet.way_px(), 0.0, 1.0);
  EXPECT_NEAR(tracklet.scene_shift_px(), 200.0, 1e-6);
  EXPECT_NEAR(tracklet.reach_px(), 200.0, 1.0);
  EXPECT_TRUE(tracklet.rests());
}

TEST(Tracklet, PathOfWhatGoesToAndFroIsLongerThanItsWay) {
  Tracklet tracklet(1, spot(100.0, 50.0), 640.0);
  for (int i = 1; i <= 60; ++i) {
    tracklet.predict(shift(0.0), kFrame_s);
    const double off = i % 30 < 15 ? i % 30 : 30 - i % 30;
    tracklet.update(spot(100.0 + off, 50.0));
  }
  EXPECT_LT(tracklet.way_px(), 10.0);
  EXPECT_GT(tracklet.path_px(), 35.0);
}

TEST(Tracklet, GateOpensWhileItIsNotSeen) {
  Tracklet tracklet(1, spot(100.0, 50.0), 640.0);
  for (int i = 1; i <= 30; ++i) {
    tracklet.predict(shift(0.0), kFrame_s);
    tracklet.update(spot(100.0, 50.0));
  }
  const double before = tracklet.distance(spot(110.0, 50.0));
  tracklet.predict(shift(0.0), 0.3);
  tracklet.miss();
  EXPECT_LT(tracklet.distance(spot(110.0, 50.0)), 0.5 * before);
  EXPECT_NEAR(tracklet.unseen_s(), 0.3, 1e-9);
}

}  // namespace
}  // namespace ols::detector
