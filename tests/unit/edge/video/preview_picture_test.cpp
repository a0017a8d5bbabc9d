#include "edge/video/preview_picture.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

namespace ols::video {
namespace {

constexpr std::size_t kDatagram_bytes = 65'000;

cv::Mat decoded(const PreviewPicture& picture) {
  return cv::imdecode(picture.jpeg, cv::IMREAD_UNCHANGED);
}

// Bright to the left of the middle, dark to the right.
cv::Mat halves(int width_px, int height_px) {
  cv::Mat gray(height_px, width_px, CV_8U, cv::Scalar(30));
  gray.colRange(0, width_px / 2).setTo(200);
  return gray;
}

TEST(PreviewPicture, IsTheFrameAtAWidthOf480) {
  const auto picture = preview_picture(halves(1280, 960));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->scale, 0.375);
  const cv::Mat shown = decoded(*picture);
  EXPECT_EQ(shown.size(), cv::Size(480, 360));
  EXPECT_NEAR(shown.at<std::uint8_t>(180, 100), 200, 5);
  EXPECT_NEAR(shown.at<std::uint8_t>(180, 380), 30, 5);
}

TEST(PreviewPicture, ASmallFrameStaysAsItIs) {
  const auto picture = preview_picture(halves(200, 150));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->scale, 1.0);
  EXPECT_EQ(decoded(*picture).size(), cv::Size(200, 150));
}

// Noise does not compress, and it is as high as no real frame.
TEST(PreviewPicture, BecomesSmallerUntilItFitsIntoADatagram) {
  cv::RNG random(7);
  cv::Mat noise(600, 480, CV_8U);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  const auto picture = preview_picture(noise);
  ASSERT_TRUE(picture);
  EXPECT_LT(picture->scale, 1.0);
  EXPECT_LT(picture->jpeg.size(), kDatagram_bytes);
  cv::Mat tall(20'000, 480, CV_8U);
  random.fill(tall, cv::RNG::UNIFORM, 0, 256);
  EXPECT_FALSE(preview_picture(tall));
}

}  // namespace
}  // namespace ols::video
