#include "calibration/pictures/landmark_snap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenery.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Refusal = Snap::Refusal;

// Drawn eight times as large and reduced: edges as a lens shows them. `draw` gets places times 8.
template <class Draw>
cv::Mat drawn(unsigned seed, const Draw& draw) {
  constexpr int kFine = 8;
  cv::Mat fine(120 * kFine, 160 * kFine, CV_32F, cv::Scalar(170.0)), picture;
  draw(fine);
  cv::resize(fine, picture, {160, 120}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(picture, picture, {}, 0.7);
  return Scenery::with_noise(picture, seed, 2.0);
}
cv::Point fine(const Vector2d& p) {
  // The centre of the first pixel is 3.5 of the eight.
  return {static_cast<int>(std::lround(8.0 * p.x() + 3.5)),
          static_cast<int>(std::lround(8.0 * p.y() + 3.5))};
}

cv::Mat roof(const Vector2d& tip, unsigned seed) {
  return drawn(seed, [&](cv::Mat& m) {
    const std::vector<cv::Point> gable{fine(tip), fine(tip + Vector2d(-40, 45)),
                                       fine(tip + Vector2d(40, 45))};
    cv::fillConvexPoly(m, gable, 60.0);
  });
}
cv::Mat lamp(const Vector2d& centre, unsigned seed) {
  return drawn(seed, [&](cv::Mat& m) { cv::circle(m, fine(centre), 26, 70.0, cv::FILLED); });
}

TEST(LandmarkSnap, TheTipOfARoofIsFoundFromAnyPointNearIt) {
  double squares = 0.0;
  int n = 0;
  for (const Vector2d& by : {Vector2d(0, 0), Vector2d(3, -2), Vector2d(-2, 3), Vector2d(1, 4)}) {
    const Vector2d tip(80.0 + 0.125 * n, 50.0 + 0.25 * n);
    const Snap snap = snap_to_structure(roof(tip, 5U + static_cast<unsigned>(n)), tip + by, 7.0);
    ASSERT_TRUE(snap) << to_string(snap.refusal);
    EXPECT_EQ(snap.shape, Snap::Shape::kCorner);
    squares += (snap.centre_px - tip).squaredNorm();
    ++n;
  }
  EXPECT_LT(std::sqrt(squares / (2 * n)), 0.25);
}

// What counts in a calibration: the same point in every picture.
TEST(LandmarkSnap, ItIsTheSamePointWhereverThePersonPoints) {
  const cv::Mat picture = roof({80.3, 50.6}, 9);
  const Snap one = snap_to_structure(picture, {79.0, 49.0}, 7.0);
  const Snap other = snap_to_structure(picture, {83.0, 53.0}, 7.0);
  ASSERT_TRUE(one && other);
  EXPECT_LT((one.centre_px - other.centre_px).norm(), 0.03);
}

TEST(LandmarkSnap, ALampIsFoundByItsCentre) {
  const Vector2d centre(70.25, 61.5);
  const Snap snap = snap_to_structure(lamp(centre, 2), centre + Vector2d(2.0, -1.5), 7.0);
  ASSERT_TRUE(snap) << to_string(snap.refusal);
  EXPECT_EQ(snap.shape, Snap::Shape::kCentre);
  EXPECT_LT((snap.centre_px - centre).norm(), 0.1);
  EXPECT_LT(snap.sd_px, 0.1);
}

TEST(LandmarkSnap, RefusesWhereThereIsNothingToHold) {
  const cv::Mat sky = drawn(1, [](cv::Mat&) {});
  EXPECT_EQ(snap_to_structure(sky, {80, 60}, 7.0).refusal, Refusal::kNoStructure);
  const cv::Mat ridge = drawn(1, [](cv::Mat& m) { m.rowRange(480, m.rows).setTo(60.0); });
  EXPECT_EQ(snap_to_structure(ridge, {80, 60}, 7.0).refusal, Refusal::kEdge);
  EXPECT_EQ(snap_to_structure(sky, {3, 60}, 7.0).refusal, Refusal::kOutside);
  EXPECT_EQ(snap_to_structure(sky, {std::nan(""), 60}, 7.0).refusal, Refusal::kOutside);
  EXPECT_FALSE(snap_to_structure(roof({80.0, 50.0}, 3), {80.0, 36.5}, 7.0));
}

}  // namespace
}  // namespace ols::calibration
