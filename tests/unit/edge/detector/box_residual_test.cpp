#include "edge/detector/box_residual.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "edge/detector/tile_medians.h"

namespace ols::detector {
namespace {

cv::Mat noise(const cv::Size& size) {
  cv::Mat image(size, CV_8U);
  cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

cv::Mat_<double> mean(const cv::Mat& image, int side) {
  cv::Mat_<double> means;
  cv::boxFilter(image, means, CV_64F, {side, side}, {-1, -1}, true, cv::BORDER_REPLICATE);
  return means;
}

TEST(BoxResidual, IsTheMeanOfNinePixelsWithoutThatOfTheRing) {
  const cv::Mat image = noise({53, 37});
  BoxResidual residual;
  residual.measure(image.t());
  residual.measure(image);  // nothing remains of an earlier one
  const cv::Mat_<double> ring = (169.0 * mean(image, 13) - 49.0 * mean(image, 7)) / 120.0;
  const cv::Mat_<double> expected = cv::abs(mean(image, 3) - ring);
  cv::Mat_<double> found;
  residual.image().convertTo(found, CV_64F, 1.0 / BoxResidual::kUnits);
  EXPECT_LT(cv::norm(found, expected, cv::NORM_INF), 1.5 / BoxResidual::kUnits);
  EXPECT_GT(cv::norm(expected, cv::NORM_INF), 50.0);
}

TEST(BoxResidual, HoldsForBlackBesideWhite) {
  cv::Mat image(40, 40, CV_8U, cv::Scalar(255));
  image(cv::Rect(19, 19, 3, 3)) = 0;
  BoxResidual residual;
  residual.measure(image);
  EXPECT_NEAR(residual.image().at<std::int16_t>(20, 20), 255 * BoxResidual::kUnits, 2);
  EXPECT_NEAR(residual.image().at<std::int16_t>(2, 2), 0, 2);
}

TEST(TileMedians, TakeTheLargestOfATileAndItsNeighbours) {
  cv::Mat values(5 * 24, 5 * 24, CV_16S, cv::Scalar(3));
  values(cv::Rect(0, 0, 24, 24)) = 9;
  values(cv::Rect(48, 48, 10, 10)) = 99;  // less than half of its tile
  TileMedians medians;
  medians.begin(values);
  EXPECT_EQ(medians.median(0, 0), 9);
  EXPECT_EQ(medians.median(2, 2), 3);
  EXPECT_EQ(medians.largest_nearby({47, 47}), 9);
  EXPECT_EQ(medians.largest_nearby({48, 47}), 3);
  medians.begin(cv::Mat::zeros(10, 10, CV_16S));
  EXPECT_EQ(medians.largest_nearby({9, 9}), 0);
}

}  // namespace
}  // namespace ols::detector
