#include "edge/tracker/object_at.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

cv::Mat sky(int level = 180) {
  cv::Mat gray(480, 640, CV_8U, cv::Scalar(level));
  cv::RNG random(3);
  cv::Mat noise(gray.size(), CV_8S);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  cv::add(gray, noise, gray, cv::noArray(), CV_8U);
  return gray;
}

TEST(ObjectAt, FindsTheThingUnderTheFinger) {
  cv::Mat gray = sky();
  const cv::Rect drone(300, 200, 24, 10), other(360, 200, 24, 10);
  cv::rectangle(gray, drone, cv::Scalar(90), cv::FILLED);
  cv::rectangle(gray, other, cv::Scalar(90), cv::FILLED);
  const auto box = object_at(gray, {306.0, 216.0});
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->x, drone.x, 3.0);
  EXPECT_NEAR(box->y, drone.y, 3.0);
  EXPECT_NEAR(box->width, drone.width, 6.0);
  EXPECT_NEAR(box->height, drone.height, 6.0);
  EXPECT_NEAR(object_at(gray, {372.0, 205.0})->x, other.x, 3.0);
}

TEST(ObjectAt, ThereIsNothingInAnEmptySkyNorBesideAnEdge) {
  cv::Mat gray = sky();
  EXPECT_FALSE(object_at(gray, {320.0, 240.0}));
  cv::rectangle(gray, {0, 300, 640, 180}, cv::Scalar(60), cv::FILLED);
  EXPECT_FALSE(object_at(gray, {320.0, 295.0})) << "a ridge is not an object";
}

TEST(ObjectAt, OfALargeThingThereIsNoBox) {
  cv::Mat gray = sky();
  cv::rectangle(gray, {200, 150, 160, 160}, cv::Scalar(90), cv::FILLED);
  EXPECT_FALSE(object_at(gray, {280.0, 230.0}));
}

TEST(ObjectAt, OutsideThePictureThereIsNothing) {
  EXPECT_FALSE(object_at(sky(), {-1.0, 20.0}));
  EXPECT_FALSE(object_at(sky(), {700.0, 20.0}));
  EXPECT_FALSE(object_at(sky(), {std::nan(""), 20.0}));
  EXPECT_FALSE(object_at(sky(), {0.0, 0.0})) << "in the very corner";
}

}  // namespace
}  // namespace ols::tracker
