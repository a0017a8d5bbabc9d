#include "calibration/pictures/gradients.h"

#include <gtest/gtest.h>

#include "scenery.h"

namespace ols::calibration {
namespace {

TEST(Gradients, NoiseOfAnEvenPictureIsFoundAndEdgesDoNotCount) {
  cv::Mat picture(400, 400, CV_32F, cv::Scalar(100.0));
  picture.colRange(200, 400).setTo(180.0);
  for (const double sd : {2.0, 5.0}) {
    EXPECT_NEAR(noise_of(Scenery::with_noise(picture, 3, sd)), sd, 0.1 * sd);
  }
}

TEST(Gradients, ARampHasItsSlopeAndNoiseTheStatedDeviation) {
  cv::Mat ramp(300, 300, CV_32F);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) ramp.at<float>(y, x) = 20.0F + 0.5F * x - 0.02F * y;
  }
  const Gradients g = gradients_of(Scenery::with_noise(ramp, 1, 3.0), 1.5);
  cv::Scalar mean, sd;
  cv::meanStdDev(g.x(cv::Rect(10, 10, 280, 280)), mean, sd);
  EXPECT_NEAR(mean[0], 0.5, 0.002);
  EXPECT_NEAR(sd[0], g.sd, 0.1 * g.sd);
  cv::meanStdDev(g.y(cv::Rect(10, 10, 280, 280)), mean, sd);
  EXPECT_NEAR(mean[0], -0.02, 0.002);
}

}  // namespace
}  // namespace ols::calibration
