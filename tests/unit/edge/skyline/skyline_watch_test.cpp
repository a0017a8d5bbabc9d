#include "edge/skyline/skyline_watch.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/world/panorama.h"
#include "tests/unit/edge/skyline/made_site.h"

namespace ols::skyline {
namespace {

CameraIntrinsics wide_camera() {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  camera.fx_px = camera.fy_px = 1500.0;
  return camera;
}

Eigen::Matrix3d R_enu_cam(double azimuth_rad) {
  Eigen::Matrix3d R;
  R << std::cos(azimuth_rad), 0.0, std::sin(azimuth_rad),  //
      -std::sin(azimuth_rad), 0.0, std::cos(azimuth_rad),  //
      0.0, -1.0, 0.0;
  return R;
}

// A station that turns around and looks at the true land; the watch knows the model of it.
class SkylineWatchTest : public ::testing::Test {
 protected:
  SkylineWatchTest()
      : site_(4),
        truth_(site_.truth(), site_.camera(), quick_map()),
        panorama_(landscape(), wide_camera(), sim::slopes_texture(landscape(), wide_camera()), 4),
        watch_(std::make_shared<land::MadeLand>(site_.model()), quick_map()) {
    panorama_.raise([this](double azimuth_rad) {
      const auto skyline = truth_.skyline(azimuth_rad);
      return skyline ? skyline->elevation_rad : -0.5;
    });
  }

  static sim::Landscape landscape() {
    sim::Landscape landscape;
    landscape.ridge_mean_rad = radians(-40.0);
    landscape.ridge_relief_rad = 0.0;
    return landscape;
  }

  void turn_around(double wrong_rad, const Geodetic& stated) {
    const Eigen::Matrix3d R_ecef = LocalFrame(stated).R_ecef_enu();
    for (double deg = 0.0; deg < 360.0; deg += 20.0) {
      cv::Mat gray;
      panorama_.draw(R_enu_cam(radians(deg)), gray);
      watch_.look(gray,
                  {ecef_from_geodetic(stated),
                   (R_ecef * R_enu_cam(radians(deg) + wrong_rad)).transpose(), wide_camera()});
    }
  }

  MadeSite site_;
  land::HorizonMap truth_;
  sim::Panorama panorama_;
  SkylineWatch watch_;
};

TEST_F(SkylineWatchTest, AWrongHeadingIsNoticedAndARightOneIsNot) {
  turn_around(0.0, site_.camera());
  ASSERT_TRUE(watch_.heading().has_value());
  EXPECT_TRUE(watch_.alarm().empty());
  watch_.forget();
  EXPECT_FALSE(watch_.heading().has_value());
  turn_around(radians(0.3), site_.camera());
  EXPECT_NEAR(watch_.heading()->error_rad, radians(0.3), 4.0 * watch_.heading()->sd_rad);
  EXPECT_NE(watch_.alarm().text.find("heading: disagrees with the skyline"), std::string::npos);
}

TEST_F(SkylineWatchTest, APlaceUnderTheGroundIsSaid) {
  Geodetic under = site_.camera();
  under.height_m -= 120.0;
  turn_around(0.0, under);
  EXPECT_NE(watch_.alarm().text.find("under the ground"), std::string::npos);
  turn_around(0.0, site_.camera());  // a right position is taken
  EXPECT_TRUE(watch_.alarm().empty());
  EXPECT_TRUE(watch_.heading().has_value());
}

}  // namespace
}  // namespace ols::skyline
