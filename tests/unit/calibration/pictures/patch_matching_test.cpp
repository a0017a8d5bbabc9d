#include "calibration/pictures/patch_matching.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenery.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Refusal = PatchMatch::Refusal;

const Scenery& scenery() {
  static const Scenery one(21);
  return one;
}

TEST(PatchMatching, FindsAPatchToAFractionOfAPixelAndSaysHowWell) {
  const cv::Mat first = scenery().view({0.0, 0.0}, 1);
  double squares = 0.0, told = 0.0;
  int n = 0;
  unsigned seed = 30;
  for (const Vector2d& shift : {Vector2d(0.5, 0.25), Vector2d(-7.3, 4.8), Vector2d(12.75, -9.1)}) {
    const cv::Mat second = scenery().view(shift, ++seed, {1.0, 0.8, 10.0});
    for (double y = 60.0; y < 420.0; y += 60.3) {
      for (double x = 60.0; x < 580.0; x += 60.7) {
        const auto patch = cut_patch(first, {x, y}, 9);
        ASSERT_TRUE(patch);
        const PatchMatch match = find_patch(*patch, second, {x, y}, 16.0);
        if (!match) continue;
        squares += (match.centre_px - Vector2d(x, y) - shift).squaredNorm();
        told += 2.0 * match.sd_px * match.sd_px;
        ++n;
      }
    }
  }
  ASSERT_GT(n, 120);
  std::printf("rms %.4f told %.4f px, %d patches\n", std::sqrt(squares / (2 * n)),
              std::sqrt(told / (2 * n)), n);
  EXPECT_LT(std::sqrt(squares / (2 * n)), 0.25);
  EXPECT_GT(std::sqrt(told / squares), 0.6);
  EXPECT_LT(std::sqrt(told / squares), 1.8);
}

TEST(PatchMatching, ATurnedPictureIsFoundWhenTheTurnIsKnown) {
  const cv::Mat first = scenery().view({0.0, 0.0}, 1);
  const Vector2d place(311.4, 240.7);
  constexpr double kTurn_rad = 0.12;
  Eigen::Matrix2d turn;  // of a patch in the second picture to the first
  turn << std::cos(kTurn_rad), -std::sin(kTurn_rad), std::sin(kTurn_rad), std::cos(kTurn_rad);
  // second(p) = first(place + turn (p - place))
  const Vector2d corner = place - turn * place;
  const cv::Mat map = (cv::Mat_<double>(2, 3) << turn(0, 0), turn(0, 1), corner.x(), turn(1, 0),
                       turn(1, 1), corner.y());
  cv::Mat second;
  cv::warpAffine(first, second, map, first.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
  const auto patch = cut_patch(first, place, 12, turn);
  ASSERT_TRUE(patch);
  const PatchMatch match = find_patch(*patch, second, place + Vector2d(3.0, -2.0), 8.0);
  ASSERT_TRUE(match) << to_string(match.refusal);
  EXPECT_LT((match.centre_px - place).norm(), 0.08);
}

TEST(PatchMatching, RefusesWhatDoesNotHold) {
  const cv::Mat first = scenery().view({0.0, 0.0}, 1);
  const auto patch = cut_patch(first, {300.0, 200.0}, 9);
  ASSERT_TRUE(patch);
  EXPECT_EQ(find_patch(*patch, first, {4.0, 200.0}, 10.0).refusal, Refusal::kOutside);
  EXPECT_FALSE(find_patch(*patch, Scenery(3).view({0.0, 0.0}, 2), {300.0, 200.0}, 12.0));
  EXPECT_FALSE(cut_patch(first, {2.0, 200.0}, 9));

  cv::Mat edge(300, 300, CV_32F, cv::Scalar(60.0));
  edge.colRange(150, 300).setTo(160.0);
  const cv::Mat shown = Scenery::with_noise(edge, 8, 1.0);
  const auto of_edge = cut_patch(shown, {150.0, 150.0}, 9);
  EXPECT_FALSE(find_patch(*of_edge, shown, {150.0, 150.0}, 10.0));

  cv::Mat twins(300, 300, CV_32F, cv::Scalar(60.0));
  for (const int x : {130, 160}) cv::circle(twins, {x, 150}, 4, 200.0, cv::FILLED);
  const cv::Mat two = Scenery::with_noise(twins, 8, 1.0);
  const auto one = cut_patch(two, {130.0, 150.0}, 7);
  EXPECT_EQ(find_patch(*one, two, {145.0, 150.0}, 30.0).refusal, Refusal::kAmbiguous);
}

}  // namespace
}  // namespace ols::calibration
