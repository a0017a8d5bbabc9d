#include "edge/tracker/core_box.h"

#include <gtest/gtest.h>

namespace ols::tracker {
namespace {

// A sky with a gradient and a little noise.
cv::Mat sky() {
  cv::Mat image(200, 300, CV_32F), noise(image.size(), CV_32F), gray;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) image.at<float>(y, x) = 120.0F + 0.3F * y;
  }
  cv::RNG(4).fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  image += noise;
  image.convertTo(gray, CV_8U);
  return gray;
}

TEST(CoreBox, IsWhatStandsOutOfALooseBox) {
  for (const int value : {60, 250}) {  // darker and brighter than the sky
    cv::Mat gray = sky();
    gray(cv::Rect(150, 90, 6, 4)).setTo(value);
    const cv::Rect2d core = find_core(gray, {120.0, 60.0, 64.0, 60.0});
    EXPECT_NEAR(core.x + core.width / 2.0, 153.0, 1.0);
    EXPECT_NEAR(core.y + core.height / 2.0, 92.0, 1.0);
    EXPECT_LT(core.width, 16.0);
    EXPECT_LT(core.height, 16.0);
    EXPECT_GE(core.width, 6.0);
  }
}

TEST(CoreBox, IsTheBoxWhereThatIsFilledOrEmpty) {
  cv::Mat gray = sky();
  const cv::Rect2d box(120.0, 60.0, 40.0, 40.0);
  EXPECT_EQ(find_core(gray, box), box);  // nothing stands out
  gray(cv::Rect(123, 63, 34, 34)).setTo(20);
  EXPECT_EQ(find_core(gray, box), box);
}

// A walker's head and feet stand out from the street more than the rest of him.
TEST(CoreBox, IsTheBoxWhereSeveralPartsStandOut) {
  cv::Mat gray = sky();
  const cv::Rect2d box(120.0, 60.0, 20.0, 50.0);
  gray(cv::Rect(127, 64, 5, 5)).setTo(250);
  EXPECT_LT(find_core(gray, box).area(), 0.3 * box.area());
  gray(cv::Rect(128, 95, 4, 6)).setTo(50);
  EXPECT_EQ(find_core(gray, box), box);
}

TEST(CoreBox, TakesBoxesAtAndOverTheBorder) {
  const cv::Mat gray = sky();
  for (const cv::Rect2d& box : {cv::Rect2d(-10.0, -10.0, 40.0, 40.0), cv::Rect2d(0, 0, 300, 200),
                                cv::Rect2d(290.0, 190.0, 20.0, 20.0), cv::Rect2d(5, 5, 3, 3)}) {
    const cv::Rect2d core = find_core(gray, box);
    EXPECT_GT(core.area(), 0.0);
    EXPECT_LE(core.area(), box.area());
  }
  const cv::Mat one_pixel(1, 1, CV_8U, cv::Scalar(9));
  EXPECT_EQ(find_core(one_pixel, {0, 0, 1, 1}), cv::Rect2d(0, 0, 1, 1));
}

}  // namespace
}  // namespace ols::tracker
