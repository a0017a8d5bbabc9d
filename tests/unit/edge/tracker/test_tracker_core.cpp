// A target that comes nearer, or goes away.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols {
namespace {

// A body and a boom, dark on a noisy sky, `side` px long; its middle is not that of its slopes.
cv::Mat picture(double side, const cv::Point2d& centre, cv::RNG& noise) {
  cv::Mat image(480, 640, CV_32F);
  noise.fill(image, cv::RNG::NORMAL, 190.0, 2.0);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const double u = (column - centre.x) / side, v = (row - centre.y) / side;
      const auto blob = [&](double at, double wide, double high) {
        return std::exp(-0.5 * (std::pow((u - at) / wide, 2) + std::pow(v / high, 2)));
      };
      image.at<float>(row, column) -=
          static_cast<float>(80.0 * blob(-0.1, 0.18, 0.14) + 60.0 * blob(0.3, 0.12, 0.06));
    }
  }
  image.convertTo(image, CV_8U);
  return image;
}

void expect_followed(double first_side, double growth_per_s) {
  cv::RNG noise(3);
  cv::Point2d centre(320.0, 240.0);
  Tracker tracker(TrackerConfig{}, 1);
  const cv::Rect2d box(centre.x + 0.5 - 0.6 * first_side, centre.y + 0.5 - 0.4 * first_side,
                       1.2 * first_side, 0.8 * first_side);
  ASSERT_FALSE(tracker.initialise({picture(first_side, centre, noise), 0.0, std::nullopt}, box));
  double nees = 0.0;
  constexpr int kFrames = 100;
  for (int k = 1; k <= kFrames; ++k) {
    const double side = first_side * std::exp(growth_per_s * k / 30.0);
    centre += cv::Point2d(0.7 * std::cos(0.05 * k), 0.5);
    const auto output = *tracker.track({picture(side, centre, noise), k / 30.0, {}}).output;
    const Eigen::Vector2d error(output.pixel.x() - centre.x, output.pixel.y() - centre.y);
    nees += 0.5 * error.dot(output.covariance_px2.inverse() * error) / kFrames;
    EXPECT_LT(error.norm(), 0.5) << k;
    EXPECT_GT(output.belief, 0.8) << k;
    EXPECT_LT(std::abs(std::log(output.box.width / (1.2 * side))), std::log(1.5)) << k;
  }
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 3.0);
}

TEST(Scale, ATargetThatComesNearerIsFollowedAtItsSizeAndPlace) { expect_followed(20.0, 0.35); }
TEST(Scale, ATargetThatGoesAwayIsFollowedAtItsSizeAndPlace) { expect_followed(60.0, -0.3); }

}  // namespace
}  // namespace ols
