#include "edge/tracker/refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "edge/tracker/target_model.h"

namespace {

using Eigen::Vector2d;

constexpr double kNoiseSd = 2.0;
const Vector2d kPlace(150.3, 140.8);

// 0 left of an edge, 1 right of it, as a lens of 1 px blurs it.
double step(double x) { return 0.5 * (1.0 + std::erf(x / std::numbers::sqrt2)); }

double bar(double x, double y, double width, double height) {
  return (step(x + width / 2) - step(x - width / 2)) *
         (step(y + height / 2) - step(y - height / 2));
}

// A dark body on a bright sky with an arm that sticks out to the right of it, `side` px wide.
class Picture {
 public:
  Picture(double side, const Vector2d& centre, cv::RNG& noise) : gray_(300, 300, CV_32F) {
    const Eigen::Matrix2d turned = Eigen::Rotation2Dd(0.3).matrix();
    noise.fill(gray_, cv::RNG::NORMAL, 190.0, kNoiseSd);
    for (int row = 0; row < gray_.rows; ++row) {
      for (int column = 0; column < gray_.cols; ++column) {
        const Vector2d off = turned * Vector2d(column - centre.x(), row - centre.y());
        const double x = off.x(), y = off.y();
        const double body = bar(x + 0.2 * side, y, 0.6 * side, 0.8 * side);
        const double arm = bar(x - 0.3 * side, y, 0.4 * side, 0.3 * side);
        gray_.at<float>(row, column) -= static_cast<float>(40.0 * (body + arm));
      }
    }
    gray_.convertTo(gray_, CV_8U);
  }
  const cv::Mat& gray() const { return gray_; }
  ols::View view() const { return {gray_, {0, 0}, 1}; }

 private:
  cv::Mat gray_;
};

Vector2d box_of_side(double side) { return {1.1 * side, 0.9 * side}; }

ols::TargetModel model_of(const Picture& first, double side) {
  return {ols::TrackerConfig{}, first.gray(), ols::box_of(kPlace, box_of_side(side))};
}

// As the tracker does it: placed by a box of a size, then measured.
std::optional<ols::RefinedPosition> measured(const ols::TargetModel& model, const ols::Scene& scene,
                                             const Vector2d& start, const Vector2d& size_px) {
  const auto placed = model.place(scene, start, size_px);
  return placed ? model.measure(scene, *placed, size_px) : std::nullopt;
}

ols::Scene scene_of(const ols::TargetModel& model, const Picture& picture, const Vector2d& place,
                    double side) {
  return model.make_scene(picture.gray(), {}, ols::box_of(place, box_of_side(side)),
                          ols::ReferenceFrames(0.3));
}

// The size that it starts from is wrong by three in a hundred, as a particle's is: at 100 px the
// edges are then off by more than they are wide.
TEST(Refinement, ALargeTargetsPlaceIsExactThoughItsSizeIsNotKnown) {
  constexpr double kSide = 100.0;
  cv::RNG noise(1);
  const auto model = model_of(Picture(kSide, kPlace, noise), kSide);
  for (int i = 0; i < 8; ++i) {
    const Vector2d moved(0.37 * i, -0.21 * i);
    const Picture picture(kSide, kPlace + moved, noise);
    const auto refined = measured(model, scene_of(model, picture, kPlace + moved, kSide),
                                  kPlace + moved + Vector2d(1.5, -1.0), 1.03 * box_of_side(kSide));
    ASSERT_TRUE(refined);
    EXPECT_LT((refined->pixel - kPlace - moved).norm(), 0.06) << i;
    EXPECT_NEAR(refined->size_px.x(), box_of_side(kSide).x(), 0.15) << i;
  }
}

// The point that was designated is not the one about which the target grows.
TEST(Refinement, WhatWasDesignatedStaysAFixedStepOffAGrowingTarget) {
  constexpr double kSide = 24.0;
  const Vector2d off(3.0, -2.0);
  cv::RNG noise(2);
  const Picture first(kSide, kPlace, noise);
  const ols::PositionRefiner refiner(first.view(), kPlace + off, box_of_side(kSide));
  const Picture grown(1.2 * kSide, kPlace, noise);
  const auto refined =
      refiner.refine(grown.view(), kPlace + off, box_of_side(kSide), 1.15 * box_of_side(kSide));
  ASSERT_TRUE(refined);
  // The body outweighs the arm: the middle of the slopes is not the picture's, by about 2 px of 24.
  EXPECT_LT((refined->pixel - kPlace - off).norm(), 0.5);
  EXPECT_NEAR(refined->size_px.x(), 1.2 * box_of_side(kSide).x(), 0.3);
}

double mean_normalised_error_squared(double side, cv::RNG& noise) {
  double sum = 0.0;
  constexpr int kPairs = 40;
  for (int i = 0; i < kPairs; ++i) {
    const auto model = model_of(Picture(side, kPlace, noise), side);
    const Vector2d place = kPlace + Vector2d(0.13 * i, 0.29 * i);
    const Picture picture(side, place, noise);
    const auto refined =
        measured(model, scene_of(model, picture, place, side), place, box_of_side(side));
    EXPECT_TRUE(refined);
    if (!refined) return INFINITY;
    const Vector2d error = refined->pixel - place;
    sum += 0.5 * error.dot(refined->covariance_px2.inverse() * error);
  }
  return sum / kPairs;
}

TEST(Refinement, ItsCovarianceIsTrueForSmallAndLargeTargets) {
  cv::RNG noise(3);
  for (const double side : {8.0, 24.0, 100.0}) {
    const double nees = mean_normalised_error_squared(side, noise);
    EXPECT_GT(nees, 0.7) << side;
    // Between the pixels noise is averaged away that neighbours share: what is left over tells less
    // than there is.
    EXPECT_LT(nees, 1.8) << side;
  }
}

}  // namespace
