#include "sim/camera/gige_sensor.h"

#include <gtest/gtest.h>

#include "sim/camera/gige_registers.h"

namespace ols::sim::gige {
namespace {

constexpr std::array<double, 3> kTint{1.0, 0.5, 0.25};

cv::Mat developed(std::uint32_t format, double gray = 100) {
  cv::Mat raw(2, 2, picture_type(format));
  develop(cv::Mat(2, 2, CV_8U, cv::Scalar(gray)), kTint, format, raw);
  return raw;
}

// Rows 0 and 1, left and right.
std::array<int, 4> bayer(std::uint32_t format) {
  const cv::Mat raw = developed(format);
  return {raw.at<std::uint8_t>(0, 0), raw.at<std::uint8_t>(0, 1), raw.at<std::uint8_t>(1, 0),
          raw.at<std::uint8_t>(1, 1)};
}

TEST(GigeSensor, MonoHasNoTint) { EXPECT_EQ(developed(kMono8).at<std::uint8_t>(1, 1), 100); }

TEST(GigeSensor, ABayerFormatIsNamedAfterItsFirstRow) {
  EXPECT_EQ(bayer(kBayerRG8), (std::array<int, 4>{100, 50, 50, 25}));
  EXPECT_EQ(bayer(kBayerGR8), (std::array<int, 4>{50, 100, 25, 50}));
  EXPECT_EQ(bayer(kBayerGB8), (std::array<int, 4>{50, 25, 100, 50}));
  EXPECT_EQ(bayer(kBayerBG8), (std::array<int, 4>{25, 50, 50, 100}));
}

TEST(GigeSensor, ColoursAreInTheOrderOfTheFormat) {
  EXPECT_EQ(picture_type(kRGB8), CV_8UC3);
  EXPECT_EQ(developed(kRGB8).at<cv::Vec3b>(1, 0), cv::Vec3b(100, 50, 25));
  EXPECT_EQ(developed(kBGR8).at<cv::Vec3b>(1, 0), cv::Vec3b(25, 50, 100));
}

}  // namespace
}  // namespace ols::sim::gige
