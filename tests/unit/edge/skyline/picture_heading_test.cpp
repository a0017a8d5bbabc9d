#include "edge/skyline/picture_heading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/skyline/expected_skyline.h"
#include "tests/unit/edge/skyline/made_site.h"

namespace ols::skyline {
namespace {

const PicturePose kPose{
    .heading_rad = radians(200.0), .tilt_rad = radians(3.0), .roll_rad = radians(-1.5)};

CameraIntrinsics camera_of() {
  CameraIntrinsics camera;
  camera.width_px = 960;
  camera.height_px = 640;
  camera.fx_px = camera.fy_px = 900.0;
  camera.cx_px = 479.5;
  camera.cy_px = 319.5;
  return camera;
}

PicturePrior prior_of(double heading_deg) {
  PicturePrior prior;
  prior.heading_rad = radians(heading_deg);
  prior.heading_sd_rad = radians(5.0);
  prior.tilt_sd_rad = radians(3.0);
  prior.roll_sd_rad = radians(1.0);
  prior.place_sd_enu_m.setConstant(kModelSd_m);
  return prior;
}

// Bright sky above dark, rough land.
cv::Mat picture_of(const land::HorizonMap& land, const CameraIntrinsics& camera) {
  cv::Mat picture(camera.height_px, camera.width_px, CV_8UC3), noise(picture.size(), CV_16SC3);
  const Rows rows = expected_rows(land, {R_enu_cam(kPose), camera});
  for (int x = 0; x < picture.cols; ++x) {
    const auto& row = rows[static_cast<std::size_t>(x / kStrip_px)];
    for (int y = 0; y < picture.rows; ++y) {
      picture.at<cv::Vec3b>(y, x) =
          y < row->at_px ? cv::Vec3b(210, 190, 180) : cv::Vec3b(60, 80, 70);
    }
  }
  cv::theRNG().state = 7;
  cv::randn(noise, 0.0, 3.0);
  cv::Mat noisy;
  picture.convertTo(noisy, CV_16SC3);
  noisy += noise;
  noisy.convertTo(picture, CV_8UC3);
  return picture;
}

class PictureHeadingTest : public testing::Test {
 protected:
  static const land::HorizonMap& model() {
    static const MadeSite site(3);
    static const land::HorizonMap map(site.model(), site.camera(), quick_map());
    return map;
  }
  static const land::HorizonMap& truth() {
    static const MadeSite site(3);
    static const land::HorizonMap map(site.truth(), site.camera(), quick_map());
    return map;
  }
  CameraIntrinsics camera_ = camera_of();
  cv::Mat picture_ = picture_of(truth(), camera_);
};

TEST_F(PictureHeadingTest, FindsTheDirectionFromSevenDegreesOff) {
  const auto found = picture_heading(picture_, camera_, {&model(), 1}, prior_of(207.0));
  ASSERT_EQ(found.doubt, "");
  const PictureFit& fit = *found.fit;
  EXPECT_LT(std::abs(fit.pose.heading_rad - kPose.heading_rad), 3.0 * fit.sd.heading_rad);
  EXPECT_LT(fit.sd.heading_rad, radians(0.45));
  EXPECT_NEAR(degrees(fit.pose.heading_rad), degrees(kPose.heading_rad), 0.3);
  EXPECT_NEAR(degrees(fit.pose.tilt_rad), degrees(kPose.tilt_rad), 0.2);
  EXPECT_NEAR(degrees(fit.pose.roll_rad), degrees(kPose.roll_rad), 0.4);
  EXPECT_GT(fit.agreeing, 350);  // of 480 strips
}

TEST_F(PictureHeadingTest, KnowsTheHorizonAllAround) {
  PicturePrior prior = prior_of(0.0);
  prior.heading_rad.reset();
  const auto found = picture_heading(picture_, camera_, {&model(), 1}, prior);
  ASSERT_EQ(found.doubt, "");
  EXPECT_NEAR(degrees(found.fit->pose.heading_rad), degrees(kPose.heading_rad), 0.3);
}

TEST_F(PictureHeadingTest, AFrameAndABranchInFrontChangeNothing) {
  cv::rectangle(picture_, {200, 0}, {260, 639}, {30, 40, 30}, cv::FILLED);
  cv::Mat framed;
  cv::copyMakeBorder(picture_, framed, 20, 60, 30, 30, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  camera_.width_px += 60;
  camera_.height_px += 80;
  camera_.cx_px += 30.0;
  camera_.cy_px += 20.0;
  const auto found = picture_heading(framed, camera_, {&model(), 1}, prior_of(203.0));
  ASSERT_EQ(found.doubt, "");
  EXPECT_NEAR(degrees(found.fit->pose.heading_rad), degrees(kPose.heading_rad), 0.3);
}

TEST_F(PictureHeadingTest, ALargePictureIsReduced) {
  cv::Mat large;
  cv::resize(picture_, large, {}, 4.0, 4.0, cv::INTER_LINEAR);
  camera_.width_px *= 4;
  camera_.height_px *= 4;
  camera_.fx_px *= 4.0;
  camera_.fy_px *= 4.0;
  camera_.cx_px = 4.0 * (camera_.cx_px + 0.5) - 0.5;
  camera_.cy_px = 4.0 * (camera_.cy_px + 0.5) - 0.5;
  const auto found = picture_heading(large, camera_, {&model(), 1}, prior_of(203.0));
  ASSERT_EQ(found.doubt, "");
  EXPECT_NEAR(degrees(found.fit->pose.heading_rad), degrees(kPose.heading_rad), 0.3);
}

TEST_F(PictureHeadingTest, SaysThatItDoesNotKnowWhenTheStatedHeadingIsElsewhere) {
  EXPECT_NE(picture_heading(picture_, camera_, {&model(), 1}, prior_of(80.0)).doubt, "");
}

TEST_F(PictureHeadingTest, LandThatHazeHidesDoesNotMislead) {
  land::HorizonMapConfig hazy = quick_map();
  hazy.reach_m = 5000.0;
  const MadeSite site(3);
  const land::HorizonMap maps[] = {model(), {site.model(), site.camera(), hazy}};
  picture_ = picture_of({site.truth(), site.camera(), hazy}, camera_);
  const auto misled = picture_heading(picture_, camera_, {&model(), 1}, prior_of(203.0));
  EXPECT_GT(std::abs(misled.fit->pose.heading_rad - kPose.heading_rad),
            3.0 * misled.fit->sd.heading_rad);
  const auto found = picture_heading(picture_, camera_, maps, prior_of(203.0));
  EXPECT_LT(std::abs(found.fit->pose.heading_rad - kPose.heading_rad),
            2.0 * found.fit->sd.heading_rad);
}

TEST(Visibilities, EachIsAThirdOfTheOneBefore) {
  EXPECT_EQ(visibilities_m(60'000.0), (std::vector<double>{60'000.0, 20'000.0, 60'000.0 / 9.0}));
  EXPECT_EQ(visibilities_m(4000.0), std::vector<double>{4000.0});
}

TEST_F(PictureHeadingTest, SaysThatItDoesNotKnowOnAPlain) {
  const land::MadeLand plain([](double, double) { return 500.0; }, kModelSd_m);
  Geodetic camera = MadeSite::kCentre;
  camera.height_m = 580.0;
  const land::HorizonMap flat(plain, camera, quick_map());
  EXPECT_NE(picture_heading(picture_of(flat, camera_), camera_, {&flat, 1}, prior_of(203.0)).doubt,
            "");
}

TEST_F(PictureHeadingTest, SaysThatItDoesNotKnowWithoutAnEdge) {
  picture_.setTo(cv::Scalar(180, 180, 180));
  EXPECT_NE(picture_heading(picture_, camera_, {&model(), 1}, prior_of(203.0)).doubt, "");
}

}  // namespace
}  // namespace ols::skyline
