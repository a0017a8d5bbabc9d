#include "edge/video/video_frame.h"

#include <gtest/gtest.h>

#include <vector>

namespace ols::video {
namespace {

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
