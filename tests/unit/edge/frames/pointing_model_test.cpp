#include "edge/frames/pointing_model.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/sight.h"
#include "tests/unit/edge/station/angle_sample.h"

namespace ols::station {
namespace {

StationConfig config() {
  StationConfig config;
  config.geometry.position = {radians(49.2), radians(16.6), 250.0};
  config.geometry.chain.heading_rad = radians(30.0);
  config.geometry.sd.position_m = 0.3;
  config.limits = {-radians(159), radians(159), -radians(46), radians(31)};
  return config;
}

TEST(PointingModel, BeginsWithTheConfiguredPose) {
  const PointingModel pointing(config());
  EXPECT_EQ(pointing.pose().position_source, sensors::PoseSource::kSurveyed);
  EXPECT_EQ(pointing.pose().position_sd_enu_m, Eigen::Vector3d::Constant(0.3));
  EXPECT_EQ(pointing.pose_revision(), 0);
}

TEST(PointingModel, AnotherPoseIsAnotherGeometry) {
  PointingModel pointing(config());
  sensors::StationPose leaning = pointing.pose();
  leaning.tilt_x_rad = radians(2.0);
  leaning.tilt_sd_rad = radians(0.1);
  pointing.set_pose(leaning);
  EXPECT_EQ(pointing.pose_revision(), 1);
  EXPECT_EQ(pointing.geometry().chain.tilt_x_rad, leaning.tilt_x_rad);
  EXPECT_EQ(pointing.geometry().sd.tilt_rad, leaning.tilt_sd_rad);
  pointing.set_pose(leaning);
  EXPECT_EQ(pointing.pose_revision(), 1) << "the same again";
}

TEST(PointingModel, AimsOnlyWithinTheTravel) {
  PointingModel pointing(config());
  const auto ahead = pointing.aim({radians(20.0), 0.0});
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(degrees(ahead->pan_rad), 10.0, 1e-3) << "pan is positive to the left";
  EXPECT_FALSE(pointing.aim({radians(210.0), 0.0})) << "behind";
  EXPECT_FALSE(pointing.aim({radians(20.0), radians(60.0)}));
  pointing.set_limits({-radians(5), radians(5), -radians(46), radians(31)});
  EXPECT_FALSE(pointing.aim({radians(20.0), 0.0})) << "the unit told of less travel";
}

TEST(PointingModel, StarsTurnAboutThePole) {
  PointingModel pointing(config());
  for (int i = 0; i <= 10; ++i) pointing.add(angle_sample(0.1 * i, {}));
  const double hour_angle_rad = radians(360.0 / 86164.0905);  // in a second
  const auto motion = pointing.star_motion(0.0, 1.0);
  ASSERT_TRUE(motion);
  // It looks level, to 30 degrees: a star there sinks or rises by the cosine of the latitude times
  // the sine of the azimuth.
  const CameraIntrinsics& camera = pointing.geometry().camera;
  const Eigen::Vector3d from(camera.cx_px, camera.cy_px, 1.0);
  const Eigen::Vector2d to = (*motion * from).hnormalized();
  const double up_rad = hour_angle_rad * std::cos(radians(49.2)) * std::sin(radians(30.0));
  const double right_rad = hour_angle_rad * std::sin(radians(49.2));
  EXPECT_NEAR(to.y() - camera.cy_px, -up_rad * camera.fy_px, 1e-3);
  EXPECT_NEAR(to.x() - camera.cx_px, right_rad * camera.fx_px, 1e-3);
}

// A unit of more than a turn gets to the same direction by other counts.
TEST(PointingModel, ReachesADirectionByTheCountsThatAreNear) {
  PointingModel pointing(config());
  pointing.set_limits({-radians(400), radians(400), -radians(46), radians(31)});
  pointing.add(angle_sample(10.0, {radians(350.0), 0.0}));
  const auto there = pointing.reachable({radians(5.0), 0.0});
  ASSERT_TRUE(there);
  EXPECT_NEAR(degrees(there->pan_rad), 365.0, 1e-9);
  const auto from_zero = pointing.reachable_from({}, {radians(5.0), 0.0});
  EXPECT_NEAR(degrees(from_zero->pan_rad), 5.0, 1e-9);
}

// The pictures show that it turns on after its newest report at 10 s.
TEST(PointingModel, GoalsAndMotionsAreByTheReportsAlone) {
  PointingModel pointing(config());
  pointing.set_limits({-radians(400), radians(400), -radians(46), radians(31)});
  for (const double time_s : {9.8, 9.9, 10.0})
    pointing.add(angle_sample(time_s, {radians(184.9), 0.0}));
  double pan_rad = radians(184.9);
  for (double from_s = 9.7; from_s < 10.25; from_s += 0.1) {
    const double turned_rad = pan_rad + (from_s > 9.95 ? radians(1.0) : 0.0);
    const tracker::ImageMotion motion{
        rotation_homography(pointing.geometry(), {pan_rad, 0.0}, {turned_rad, 0.0}),
        Eigen::Vector2d(640, 480), 0.1};
    camera::Frame frame;
    frame.mid_exposure_s = from_s + 0.1;
    pointing.add(motion, from_s, frame);
    pan_rad = turned_rad;
  }
  const auto carried = pointing.angles_at(10.3);
  ASSERT_TRUE(carried);
  EXPECT_NEAR(degrees(carried->angles.pan_rad), 187.9, 0.1);
  EXPECT_NEAR(degrees(pointing.reachable({radians(5.0), 0.0})->pan_rad), 5.0, 1e-9);
  EXPECT_FALSE(pointing.homography(10.0, 10.3));
}

TEST(PointingModel, APixelOnTheAxisIsThePrincipalPoint) {
  const PointingModel pointing(config());
  const CameraIntrinsics& camera = config().geometry.camera;
  const auto pixel = pointing.pixel_of({}, {radians(30.0), 0.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), camera.cx_px, 0.05);
  EXPECT_NEAR(pixel->y(), camera.cy_px, 0.05);
  EXPECT_TRUE(pointing.in_picture(*pixel));
  EXPECT_FALSE(pointing.in_picture({camera.width_px + 1.0, 10.0}));
  EXPECT_FALSE(pointing.in_picture({10.0, -1.0}));
}

TEST(PointingModel, KnowsNoMotionAcrossForgottenAngles) {
  PointingModel pointing(config());
  pointing.add(angle_sample(10.0, {}));
  pointing.add(angle_sample(10.1, {radians(0.1), 0.0}));
  const auto homography = pointing.homography(10.0, 10.1);
  ASSERT_TRUE(homography);
  EXPECT_GT((*homography / (*homography)(2, 2) - Eigen::Matrix3d::Identity()).norm(), 1.0);
  pointing.forget_angles();
  EXPECT_FALSE(pointing.homography(10.0, 10.1));
  EXPECT_FALSE(pointing.newest_angles());
}

}  // namespace
}  // namespace ols::station
