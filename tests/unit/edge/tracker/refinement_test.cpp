#include "edge/tracker/refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

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
  ols::tracker::FrameView view() const { return {gray_, {0, 0}, 1}; }

 private:
  cv::Mat gray_;
};

Vector2d box_of_side(double side) { return {1.1 * side, 0.9 * side}; }

ols::tracker::TargetModel model_of(const Picture& first, double side) {
  return {ols::tracker::TrackerConfig{}, first.gray(),
          ols::tracker::box_of(kPlace, box_of_side(side))};
}

// As the tracker does it: placed by a box of a size, then measured.
std::optional<ols::tracker::RefinedPosition> measured(const ols::tracker::TargetModel& model,
                                                      const ols::tracker::Scene& scene,
                                                      const Vector2d& start,
                                                      const Vector2d& size_px) {
  const auto placed = model.place(scene, start, size_px);
  return placed ? model.measure(scene, *placed, size_px) : std::nullopt;
}

ols::tracker::Scene scene_of(const ols::tracker::TargetModel& model, const Picture& picture,
                             const Vector2d& place, double side) {
  return model.make_scene(picture.gray(), {}, ols::tracker::box_of(place, box_of_side(side)),
                          ols::tracker::ReferenceFrames(0.3));
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
    EXPECT_LT((refined->centre - kPlace - moved).norm(), 0.06) << i;
    EXPECT_NEAR(refined->size_px.x(), box_of_side(kSide).x(), 0.15) << i;
  }
}

// The designated point is not the middle of what tells the place: it moves with the target's size,
// and knows it no better.
TEST(Refinement, WhatWasDesignatedStaysOnAGrowingTarget) {
  constexpr double kSide = 24.0;
  const Vector2d off(3.0, -2.0);
  cv::RNG noise(2);
  const Picture first(kSide, kPlace, noise);
  const ols::tracker::PositionRefiner refiner(first.view(), kPlace + off, box_of_side(kSide));
  double nees = 0.0;
  constexpr int kPictures = 40;
  for (int i = 0; i < kPictures; ++i) {
    const double growth = 0.7 + 0.02 * i;
    const Picture grown(growth * kSide, kPlace, noise);
    const Vector2d size = growth * box_of_side(kSide);
    const auto refined = refiner.refine(grown.view(), kPlace + growth * off, size, 0.97 * size);
    ASSERT_TRUE(refined) << growth;
    EXPECT_NEAR(refined->size_px.x(), size.x(), 0.3);
    const Vector2d error = refined->centre - kPlace - growth * off;
    EXPECT_LT(error.norm(), 0.25) << growth;
    nees += 0.5 * error.dot(refined->point_covariance_px2({0.0, 0.0}).inverse() * error);
  }
  // With the first picture's own noise, which stays.
  EXPECT_GT(nees / kPictures, 0.4);
  EXPECT_LT(nees / kPictures, 2.0);
}

// What the picture does not show says nothing.
TEST(Refinement, ATargetThatLeavesThePictureIsPlacedByWhatIsLeftOfIt) {
  constexpr double kSide = 40.0;
  cv::RNG noise(4);
  const Picture first(kSide, kPlace, noise);
  const ols::tracker::PositionRefiner refiner(first.view(), kPlace, box_of_side(kSide));
  for (const double outside : {0.0, 10.0, 16.0}) {
    const Vector2d place(299.0 - 0.5 * kSide + outside, 140.0);
    const Picture picture(kSide, place, noise);
    const auto refined = refiner.refine(picture.view(), place + Vector2d(1.0, -1.0),
                                        box_of_side(kSide), box_of_side(kSide));
    ASSERT_TRUE(refined) << outside;
    EXPECT_LT((refined->centre - place).norm(), 0.3) << outside;
  }
  const Vector2d gone(299.0 + 0.3 * kSide, 140.0);
  EXPECT_FALSE(refiner.refine(Picture(kSide, gone, noise).view(), gone, box_of_side(kSide)));
}

// Left over are not the pixels' own fluctuations alone, but spots that several of them share.
TEST(Refinement, WhatNeighboursShareIsTold) {
  constexpr double kSide = 24.0;
  cv::RNG noise(5);
  const Picture first(kSide, kPlace, noise);
  const ols::tracker::PositionRefiner refiner(first.view(), kPlace, box_of_side(kSide));
  const auto shared_noise = [&](bool spots) {
    double sum = 0.0;
    constexpr int kPictures = 20;
    for (int i = 0; i < kPictures; ++i) {
      cv::Mat gray = Picture(kSide, kPlace, noise).gray().clone();
      if (spots) {
        cv::Mat spotted(gray.size(), CV_32F);
        noise.fill(spotted, cv::RNG::NORMAL, 0.0, 30.0);
        cv::GaussianBlur(spotted, spotted, {0, 0}, 2.0);
        cv::add(gray, spotted, gray, cv::noArray(), CV_8U);
      }
      const auto refined =
          refiner.refine({gray, {0, 0}, 1}, kPlace, box_of_side(kSide), box_of_side(kSide));
      EXPECT_TRUE(refined);
      sum += refined ? refined->shared_noise : 0.0;
    }
    return sum / kPictures;
  };
  EXPECT_NEAR(shared_noise(false), 1.0, 0.4);
  EXPECT_GT(shared_noise(true), 2.0);
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
    const Vector2d error = refined->centre - place;
    sum += 0.5 * error.dot(refined->point_covariance_px2({0.0, 0.0}).inverse() * error);
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
    EXPECT_LT(nees, 1.5) << side;
  }
}

}  // namespace
