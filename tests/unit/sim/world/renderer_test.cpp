#include "sim/world/renderer.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

namespace ols::sim {
namespace {

// Everything off but what a test asks for; a picture of 640x480 for speed.
Scenario plain_scenario() {
  Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
  s.camera.width_px = 640;
  s.camera.height_px = 480;
  s.camera.cx_px = 319.5;
  s.camera.cy_px = 239.5;
  s.errors.noise.on = s.errors.brightness.on = s.errors.motion_blur.on = false;
  return s;
}

// Small translation from one picture to the other: least squares on the gradients.
Eigen::Vector2d shift_between(const cv::Mat& from, const cv::Mat& to) {
  cv::Mat a, b, gx, gy;
  cv::GaussianBlur(from, a, {}, 2.0);
  cv::GaussianBlur(to, b, {}, 2.0);
  a.convertTo(a, CV_32F);
  b.convertTo(b, CV_32F);
  const cv::Mat mean = 0.5 * (a + b), difference = a - b;
  cv::Sobel(mean, gx, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(mean, gy, CV_32F, 0, 1, 3, 1.0 / 8);
  Eigen::Matrix2d normal;
  normal << gx.dot(gx), gx.dot(gy), gx.dot(gy), gy.dot(gy);
  return normal.inverse() * Eigen::Vector2d(gx.dot(difference), gy.dot(difference));
}

class RendererTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Scenario s = plain_scenario();
    slopes_ = slopes_texture(s.landscape, s.camera);
  }
  static ExposureTruth aimed(const World& world, std::size_t station, double time_s,
                             const Eigen::Vector2d& pixel) {
    ExposureTruth e;
    e.mid_s = time_s;
    e.exposure_s = world.scenario().exposure_s;
    e.mid = aim_at(world.stations()[station].truth, world.target(0, time_s).p_ecef, pixel).value();
    e.start = e.end = e.mid;
    return e;
  }
  static inline cv::Mat slopes_;
};

TEST_F(RendererTest, TargetIsDrawnWhereTheTruthSaysInFrontOfTheSky) {
  Scenario s = plain_scenario();
  s.landscape.cloudiness = 0.0;
  s.landscape.ridge_mean_rad = radians(-10.0);
  const World world(s, 4);
  for (std::size_t station = 0; station < world.stations().size(); ++station) {
    Renderer renderer(world, station, slopes_);
    const ExposureTruth e = aimed(world, station, 13.0, {250.3, 199.7});
    cv::Mat with;
    const ViewTruth truth = renderer.draw(e, with);
    ASSERT_TRUE(truth.visible);
    EXPECT_LT((truth.centre_px - Eigen::Vector2d(250.3, 199.7)).norm(), 0.01);
    const StationTruth& own = world.stations()[station];
    const Eigen::Vector3d line =
        world.target(0, 13.0).p_ecef - LocalFrame(own.truth.position).to_ecef({0.0, 0.0, 0.0});
    EXPECT_NEAR(truth.px_per_m * line.norm() / own.truth.camera.fx_px, 1.0, 0.02);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const double sky = with.at<std::uint8_t>(150, 250);
    for (int y = 160; y < 240; ++y) {
      for (int x = 200; x < 300; ++x) {
        const double darker = sky - with.at<std::uint8_t>(y, x);
        if (std::abs(darker) > 2.0) sum += darker * Eigen::Vector3d(x, y, 1.0);
      }
    }
    EXPECT_LT((sum.head<2>() / sum.z() - truth.centre_px).norm(), 0.1) << station;
  }
}

TEST_F(RendererTest, BackgroundMovesByTheHomographyOfTheRotation) {
  Scenario s = plain_scenario();
  s.landscape.ridge_mean_rad = radians(30.0);  // nothing but slopes
  s.landscape.ridge_relief_rad = 0.0;
  s.errors.distortion.on = false;
  const World world(s, 4);
  const StationGeometry& truth = world.stations()[0].truth;
  Renderer renderer(world, 0, slopes_);
  // The drone is out of sight: elevation below the horizon.
  ExposureTruth e;
  e.mid = e.start = e.end = {0.02, -0.15};
  cv::Mat first, second, moved;
  EXPECT_FALSE(renderer.draw(e, first).visible);
  e.mid = e.start = e.end = {0.0213, -0.1508};
  renderer.draw(e, second);
  // Far points seen by both: R_enu_cam of both exposures, written out.
  const Eigen::Matrix3d R1 = enu_from_camera(truth.chain, {0.02, -0.15}).linear().transpose();
  const Eigen::Matrix3d R2 = enu_from_camera(truth.chain, {0.0213, -0.1508}).linear().transpose();
  const Eigen::Matrix3d K = camera_matrix(truth.camera);
  const Eigen::Matrix3d H = K * R2 * R1.transpose() * K.inverse();
  cv::Mat H_cv(3, 3, CV_64F);
  for (int i = 0; i < 9; ++i) H_cv.at<double>(i / 3, i % 3) = H(i / 3, i % 3);
  cv::warpPerspective(first, moved, H_cv, first.size());
  const cv::Rect inner(60, 60, 520, 360);
  EXPECT_LT(shift_between(moved(inner), second(inner)).norm(), 0.02);
  EXPECT_GT(std::abs((H * Eigen::Vector3d(320, 240, 1)).hnormalized().x() - 320), 10.0);
}

TEST_F(RendererTest, TheSameExposureGivesTheSamePicture) {
  Scenario s = plain_scenario();
  s.errors.noise.on = s.errors.brightness.on = s.errors.motion_blur.on = true;
  const World world(s, 9);
  Renderer renderer(world, 1, slopes_), again(world, 1, slopes_);
  ExposureTruth e = aimed(world, 1, 2.0, {300, 200});
  e.frame = 17;
  cv::Mat a, b, other;
  renderer.draw(e, a);
  e.frame = 18;
  renderer.draw(e, other);
  EXPECT_GT(cv::norm(a, other, cv::NORM_L1), 0.0) << "noise is new in every frame";
  e.frame = 17;
  again.draw(e, b);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
}

TEST_F(RendererTest, NoiseHasTheStatedDeviation) {
  Scenario s = plain_scenario();
  const World quiet(s, 9);
  s.errors.noise.on = true;
  s.errors.noise.sd_gray = 3.0;
  const World noisy(s, 9);
  ExposureTruth e = aimed(quiet, 0, 2.0, {300, 200});
  cv::Mat a, b, difference;
  Renderer(quiet, 0, slopes_).draw(e, a);
  Renderer(noisy, 0, slopes_).draw(e, b);
  cv::subtract(b, a, difference, cv::noArray(), CV_32F);
  cv::Scalar mean, deviation;
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(mean[0], 0.0, 0.05);
  EXPECT_NEAR(deviation[0], 3.0, 0.1);
}

TEST_F(RendererTest, LightMakesThePictureBrighterUntilItSaturates) {
  const World world(plain_scenario(), 9);
  Renderer renderer(world, 0, slopes_);
  ExposureTruth e = aimed(world, 0, 2.0, {300, 200});
  cv::Mat normal, half, glaring;
  renderer.draw(e, normal);
  e.light = 0.5;
  renderer.draw(e, half);
  e.light = 50.0;
  renderer.draw(e, glaring);
  EXPECT_NEAR(cv::mean(half)[0] / cv::mean(normal)[0], 0.5, 0.01);
  EXPECT_GT(cv::mean(glaring)[0], 240.0);
}

TEST_F(RendererTest, VignettingDarkensTheCorners) {
  Scenario s = plain_scenario();
  s.landscape.cloudiness = 0.0;
  s.landscape.ridge_mean_rad = radians(-10.0);
  s.errors.brightness.on = true;
  s.errors.brightness.gain_sd = 0.0;
  s.errors.brightness.vignetting = 0.4;
  const World world(s, 9);
  cv::Mat gray;
  Renderer(world, 0, slopes_).draw(aimed(world, 0, 2.0, {300, 200}), gray);
  const double middle = gray.at<std::uint8_t>(300, 320);
  EXPECT_NEAR(gray.at<std::uint8_t>(2, 2) / middle, 0.6, 0.05);
}

TEST_F(RendererTest, AFastTurnBlursTheBackground) {
  Scenario s = plain_scenario();
  s.landscape.ridge_mean_rad = radians(30.0);
  const World still(s, 9);
  s.errors.motion_blur.on = true;
  const World world(s, 9);
  ExposureTruth e;
  e.start = {0.0196, -0.15}, e.mid = {0.02, -0.15}, e.end = {0.0204, -0.15};
  const auto roughness = [&](const World& w) {
    cv::Mat gray, slope;
    Renderer(w, 0, slopes_).draw(e, gray);
    cv::Sobel(gray, slope, CV_32F, 1, 0);
    return cv::norm(slope, cv::NORM_L1);
  };
  EXPECT_LT(roughness(world), 0.7 * roughness(still));
}

TEST_F(RendererTest, OutsideTheFieldNothingIsVisible) {
  const World world(plain_scenario(), 1);
  ExposureTruth e = aimed(world, 0, 1.0, {700.0, 200.0});
  EXPECT_FALSE(view_truth(world, 0, e).visible);
  e.mid.pan_rad += kPi;  // behind
  EXPECT_FALSE(view_truth(world, 0, e).visible);
}

}  // namespace
}  // namespace ols::sim
