#include "edge/video/video_frame.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "edge/video/preview_picture.h"

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

const cv::Size kFrame(1280, 960);

cv::Rect region(double x, double y, double width, double height) {
  return region_of({.max_width_px = 640, .quality = 60, .region = {x, y, width, height}}, kFrame);
}

TEST(VideoRegion, WithoutSizeTheWholeFrame) {
  EXPECT_EQ(region(0, 0, 0, 0), cv::Rect(0, 0, 1280, 960));
  EXPECT_EQ(region(10, 10, -5, 20), cv::Rect(0, 0, 1280, 960));
}

TEST(VideoRegion, EveryPixelThatItTouches) {
  EXPECT_EQ(region(10.2, 20.0, 5.0, 5.0), cv::Rect(10, 20, 6, 5));
}

TEST(VideoRegion, ItStaysWithinTheFrameAndIsNeverEmpty) {
  const cv::Rect whole(0, 0, 1280, 960);
  for (const auto& r : std::vector<cv::Rect2d>{{-100, -100, 200, 200},
                                               {1270, 950, 500, 500},
                                               {5000, 5000, 10, 10},
                                               {-5000, -5000, 10, 10},
                                               {0.4, 0.4, 1e-9, 1e-9}}) {
    const cv::Rect got = region(r.x, r.y, r.width, r.height);
    EXPECT_EQ(got & whole, got) << r;
    EXPECT_GE(got.area(), 1) << r;
  }
  EXPECT_EQ(region(-100, -100, 200, 200), cv::Rect(0, 0, 100, 100));
}

cv::Size size_of(VideoCodec codec, int max_width_px, const cv::Size& region_px) {
  return picture_size({.max_width_px = max_width_px, .codec = codec}, region_px);
}

TEST(VideoPictureSize, AsWideAsAskedAndNeverEnlarged) {
  EXPECT_EQ(size_of(VideoCodec::kJpeg, 640, kFrame), cv::Size(640, 480));
  EXPECT_EQ(size_of(VideoCodec::kJpeg, 4000, {31, 7}), cv::Size(31, 7));
  EXPECT_EQ(size_of(VideoCodec::kJpeg, 1, {1000, 10}), cv::Size(1, 1));
}

TEST(VideoPictureSize, OfAStreamEvenAndWhatADecoderTakes) {
  EXPECT_EQ(size_of(VideoCodec::kH264, 640, kFrame), cv::Size(640, 480));
  EXPECT_EQ(size_of(VideoCodec::kH264, 641, {1280, 962}), cv::Size(640, 480));
  EXPECT_EQ(size_of(VideoCodec::kH264, 640, {31, 7}), cv::Size(30, 16));
  EXPECT_EQ(size_of(VideoCodec::kH264, 5000, {4096, 2160}), cv::Size(1920, 1012));
  EXPECT_EQ(size_of(VideoCodec::kH264, 5000, {100, 4000}), cv::Size(48, 1920));
}

}  // namespace
}  // namespace ols::video
