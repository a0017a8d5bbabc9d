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

}  // namespace
}  // namespace ols::video
