#include "edge/tracker/local_contrast.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

TEST(LocalContrast, IsTheMiddleLessItsSurroundings) {
  cv::Mat gray(200, 200, CV_8U, cv::Scalar(150));
  cv::rectangle(gray, cv::Rect(90, 90, 20, 20), cv::Scalar(50), cv::FILLED);
  const LocalContrast contrast({gray, {0, 0}, 1}, {0, 0, 200, 200});
  EXPECT_NEAR(contrast({99.5, 99.5}, {20.0, 20.0}), -100.0, 10.0);
  EXPECT_NEAR(contrast({40.0, 40.0}, {20.0, 20.0}), 0.0, 1e-9);
}

TEST(LocalContrast, IsNothingOutsideOfItsArea) {
  cv::Mat gray(200, 200, CV_8U, cv::Scalar(150));
  cv::rectangle(gray, cv::Rect(90, 90, 20, 20), cv::Scalar(50), cv::FILLED);
  const LocalContrast contrast({gray, {0, 0}, 1}, {0, 0, 60, 200});
  EXPECT_EQ(contrast({99.5, 99.5}, {20.0, 20.0}), 0.0);
}

}  // namespace
}  // namespace ols::tracker
