#include "edge/frames/skyline_picture.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/lens.h"
#include "tests/unit/edge/station/angle_sample.h"

namespace ols::station {
namespace {

constexpr double kHeadingSd_rad = radians(0.02);

StationConfig config() {
  StationConfig config;
  config.geometry.position = {radians(49.2), radians(16.6), 250.0};
  config.geometry.chain.heading_rad = radians(30.0);
  config.geometry.sd.heading_rad = kHeadingSd_rad;
  config.geometry.sd.tilt_rad = radians(0.01);
  config.geometry.sd.position_m = 0.3;
  config.angles.step_rad = 0.0;
  config.angles.acceleration_sd_rad_s2 = 0.0;
  return config;
}

std::deque<camera::Frame> frames(std::initializer_list<double> times_s) {
  std::deque<camera::Frame> frames;
  for (const double time_s : times_s) frames.emplace_back().mid_exposure_s = time_s;
  return frames;
}

// The unit turns by `turn_rad` between 10.1 and 10.3 s, and stands before and afterwards.
void turn(PointingModel& pointing, double turn_rad) {
  for (const double time_s : {9.9, 10.1}) pointing.add(angle_sample(time_s, {0.2, 0.1}));
  for (const double time_s : {10.3, 10.5})
    pointing.add(angle_sample(time_s, {0.2 + turn_rad, 0.1}));
}

TEST(SkylinePictureTest, IsTheNewestWithAnglesOnBothSidesAndSaysWhatIsStated) {
  PointingModel pointing(config());
  turn(pointing, 0.0);
  const auto picture = skyline_picture(frames({10.0, 10.4, 10.52}), pointing);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->mid_exposure_s, 10.4);
  EXPECT_NEAR(picture->azimuth_sd_rad, kHeadingSd_rad, 0.05 * kHeadingSd_rad);
  EXPECT_NEAR(picture->elevation_sd_rad, radians(0.01), radians(0.002));
  EXPECT_EQ(picture->position_sd_enu_m, Eigen::Vector3d::Constant(0.3));
  const auto camera = pointing.camera_at(*pointing.angles_at(10.4));
  EXPECT_EQ(picture->camera.centre_ecef, camera->centre_ecef);
  EXPECT_EQ(picture->camera.R_camera_ecef, camera->R_camera_ecef);
}

TEST(SkylinePictureTest, IsNoneWhileTheUnitTurnsHoweverSlowlyItIsAsked) {
  for (const double turn_rad : {radians(0.01), radians(1.0)}) {
    PointingModel pointing(config());
    turn(pointing, turn_rad);
    EXPECT_FALSE(skyline_picture(frames({10.0, 10.2}), pointing)) << turn_rad;
    EXPECT_TRUE(skyline_picture(frames({10.2, 10.4}), pointing)) << turn_rad;
  }
}

TEST(SkylinePictureTest, WithoutAPositionThereIsNone) {
  PointingModel pointing(config());
  turn(pointing, 0.0);
  sensors::StationPose nowhere = pointing.pose();
  nowhere.position_source = sensors::PoseSource::kNone;
  pointing.set_pose(nowhere);
  EXPECT_FALSE(skyline_picture(frames({10.0}), pointing));
}

TEST(SkylinePictureTest, TheErrorsOfTheMountsAnglesAreStatedToo) {
  PointingModel pointing(config());
  for (const double time_s : {9.9, 10.1}) {
    mount::AngleSample sample = angle_sample(time_s, {});
    sample.doubt = {radians(0.05), radians(0.05)};
    pointing.add(sample);
  }
  const auto picture = skyline_picture(frames({10.0}), pointing);
  ASSERT_TRUE(picture);
  EXPECT_GT(picture->azimuth_sd_rad, radians(0.035));
  EXPECT_GT(picture->elevation_sd_rad, radians(0.035));
}

TEST(SkylinePictureTest, AFisheyesCircleMayBeNarrowerThanThePicture) {
  StationConfig with_fisheye = config();
  CameraIntrinsics& camera = with_fisheye.geometry.camera;
  camera.model = LensModel::kFisheye;
  camera.fx_px = camera.fy_px = 300.0;
  camera.k1 = -0.1;
  ASSERT_FALSE(unproject(camera, {0.0, camera.cy_px}));
  ASSERT_FALSE(unproject(camera, {camera.width_px - 1.0, camera.cy_px}));
  PointingModel pointing(with_fisheye);
  turn(pointing, 0.0);
  const auto picture = skyline_picture(frames({10.0}), pointing);
  ASSERT_TRUE(picture);
  EXPECT_NEAR(picture->azimuth_sd_rad, kHeadingSd_rad, 0.5 * kHeadingSd_rad);
  EXPECT_GT(picture->elevation_sd_rad, radians(0.005));
}

class ZoomPictureTest : public ::testing::Test {
 protected:
  // Zoom positions at 9.9 and 10.1 s.
  static std::optional<skyline::StatedPicture> picture(double focal_sd, double from, double to) {
    std::vector<ZoomPoint> points(2);
    for (ZoomPoint& point : points) point.camera = config().geometry.camera;
    points[0].camera.fx_px = points[0].camera.fy_px = 1300.0;
    points[1].position = 1.0;
    points[1].camera.fx_px = points[1].camera.fy_px = 13000.0;
    for (ZoomPoint& point : points) point.focal_sd_px = focal_sd * point.camera.fx_px;
    StationConfig with_zoom = config();
    with_zoom.zoom.emplace(ZoomTable(points), 1e-6);
    PointingModel pointing(with_zoom);
    turn(pointing, 0.0);
    pointing.add(lens::ZoomSample{9.9, 0.01, from});
    pointing.add(lens::ZoomSample{10.1, 0.01, to});
    return skyline_picture(frames({10.0, 10.4}), pointing);
  }
};

TEST_F(ZoomPictureTest, IsNoneWhileTheZoomMoves) {
  EXPECT_FALSE(picture(0.001, 0.1, 0.12));
  const auto still = picture(0.001, 0.1, 0.1);
  ASSERT_TRUE(still);
  EXPECT_EQ(still->mid_exposure_s, 10.0) << "of the later one, the zoom is not known yet";
}

TEST_F(ZoomPictureTest, StatesTheErrorOfTheFocalLengthAtItsEdges) {
  const auto exact = picture(0.0, 0.0, 0.0), inexact = picture(0.01, 0.0, 0.0);
  ASSERT_TRUE(exact && inexact);
  const double tangent = 640.0 / 1300.0;
  const double expected_rad = 0.01 * tangent / (1.0 + tangent * tangent);
  EXPECT_NEAR(std::sqrt(std::pow(inexact->azimuth_sd_rad, 2) - std::pow(exact->azimuth_sd_rad, 2)),
              expected_rad, 0.05 * expected_rad);
}

}  // namespace
}  // namespace ols::station
