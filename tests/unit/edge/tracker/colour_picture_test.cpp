#include "edge/tracker/colour_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

constexpr int kSide = 40;
const cv::Scalar kLeft(40, 90, 200), kRight(180, 60, 20);  // blue, green, red

cv::Mat two_colours() {
  cv::Mat bgr(kSide, kSide, CV_8UC3, kLeft);
  bgr.colRange(kSide / 2, kSide).setTo(kRight);
  return bgr;
}

// Channels of the pattern's first two pixels, and of the two below.
cv::Mat mosaic(const cv::Mat& bgr, const std::array<int, 4>& channels) {
  cv::Mat raw(bgr.size(), CV_8U);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      raw.at<std::uint8_t>(y, x) =
          bgr.at<cv::Vec3b>(y, x)[channels[static_cast<std::size_t>(2 * (y % 2) + x % 2)]];
  return raw;
}

void expect_both_colours(const ColourPicture& picture) {
  // Odd corners, or the pattern would be right by accident.
  for (const cv::Rect& area : {cv::Rect(5, 7, 6, 6), cv::Rect(29, 31, 6, 6)}) {
    const ColourPicture::Part part = picture.part(area);
    const cv::Point middle = area.tl() + cv::Point(3, 3) - part.origin;
    const cv::Vec3b found = part.bgr.at<cv::Vec3b>(middle);
    const cv::Scalar wanted = area.x < kSide / 2 ? kLeft : kRight;
    for (int c = 0; c < 3; ++c) EXPECT_EQ(found[c], wanted[c]) << area << " channel " << c;
  }
}

TEST(ColourPicture, EveryLayoutGivesTheSameColours) {
  constexpr int kB = 0, kG = 1, kR = 2;
  const cv::Mat bgr = two_colours();
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  expect_both_colours({bgr, ColourLayout::kBgr});
  expect_both_colours({rgb, ColourLayout::kRgb});
  expect_both_colours({mosaic(bgr, {kR, kG, kG, kB}), ColourLayout::kBayerRg});
  expect_both_colours({mosaic(bgr, {kG, kR, kB, kG}), ColourLayout::kBayerGr});
  expect_both_colours({mosaic(bgr, {kG, kB, kR, kG}), ColourLayout::kBayerGb});
  expect_both_colours({mosaic(bgr, {kB, kG, kG, kR}), ColourLayout::kBayerBg});
}

TEST(ColourPicture, APartBeyondTheEdgeIsTheNearestOne) {
  const ColourPicture picture{mosaic(two_colours(), {2, 1, 1, 0}), ColourLayout::kBayerRg};
  for (const cv::Rect& area : {cv::Rect(-90, -90, 8, 8), cv::Rect(900, 900, 8, 8)}) {
    const ColourPicture::Part part = picture.part(area);
    ASSERT_FALSE(part.bgr.empty());
    EXPECT_EQ(part.origin.x > kSide / 2, area.x > 0);
  }
}

TEST(ColourPicture, IsValidWithTheChannelsOfItsLayoutAndTheSizeOfTheGreyPicture) {
  const ColourPicture colours{two_colours(), ColourLayout::kRgb};
  EXPECT_TRUE(colours.valid({kSide, kSide}));
  EXPECT_FALSE(colours.valid({kSide, kSide + 1}));
  EXPECT_FALSE((ColourPicture{colours.image, ColourLayout::kBayerBg}.valid({kSide, kSide})));
}

}  // namespace
}  // namespace ols::tracker
