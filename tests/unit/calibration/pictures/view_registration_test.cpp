#include "calibration/pictures/view_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scenery.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Refusal = ViewRegistration::Refusal;

const Scenery& scenery() {
  static const Scenery one(7);
  return one;
}

const std::vector<Vector2d> kShifts{{0.0, 0.0},   {0.25, -0.4},  {2.5, 1.37},
                                    {-3.1, 7.75}, {31.6, -22.2}, {0.5, 0.5}};

struct Quality {
  double worst_px = 0.0, rms_px = 0.0, told_px = 0.0;
};

// Over all shifts, each with noise of its own.
Quality quality(const Light& light, const std::function<void(cv::Mat&)>& disturb = {}) {
  Quality q;
  const cv::Mat reference = scenery().view({0.0, 0.0}, 1);
  unsigned seed = 10;
  for (const Vector2d& shift : kShifts) {
    cv::Mat view = scenery().view(shift, ++seed, light);
    if (disturb) disturb(view);
    const ViewRegistration found = register_view(reference, view);
    EXPECT_EQ(found.refusal, Refusal::kNone) << shift.transpose();
    const Vector2d miss = found.shift_px - shift;
    q.worst_px = std::max(q.worst_px, miss.cwiseAbs().maxCoeff());
    q.rms_px += miss.squaredNorm();
    q.told_px += found.sd_px * found.sd_px;
  }
  q.rms_px = std::sqrt(q.rms_px / (2.0 * static_cast<double>(kShifts.size())));
  q.told_px = std::sqrt(q.told_px / static_cast<double>(kShifts.size()));
  std::printf("rms %.4f worst %.4f told %.4f px\n", q.rms_px, q.worst_px, q.told_px);
  return q;
}

TEST(ViewRegistration, TheSameLightIsRegisteredToHundredths) {
  const Quality q = quality({});
  EXPECT_LT(q.worst_px, 0.03);
  EXPECT_LT(q.rms_px, 1.5 * q.told_px);
  EXPECT_GT(q.rms_px, 0.3 * q.told_px);
}

TEST(ViewRegistration, HazeAndDuskDoNotMatter) {
  EXPECT_LT(quality({1.0, 0.35, 60.0}).worst_px, 0.08);
  EXPECT_LT(quality({1.0, 0.5, -70.0}).worst_px, 0.08);
}

TEST(ViewRegistration, TheSunFromTheOtherSideLeavesAFractionOfAPixel) {
  EXPECT_LT(quality({0.3, 1.0, 0.0}).worst_px, 0.15);
  EXPECT_LT(quality({-1.0, 1.0, 0.0}).worst_px, 0.3);
}

// A lorry, scaffolding: a fifth of the picture from elsewhere, and moving with it.
TEST(ViewRegistration, AFifthOfMovedContentDoesNotMatter) {
  const cv::Mat other = Scenery(99).view({3.0, 2.0}, 5);
  const cv::Rect lorry(60, 120, 260, 236);
  const auto put = [&](cv::Mat& view) { other(lorry).copyTo(view(lorry)); };
  EXPECT_LT(quality({}, put).worst_px, 0.04);
}

TEST(ViewRegistration, RefusesWhatItCannotTell) {
  const cv::Mat reference = scenery().view({0.0, 0.0}, 1);
  const auto refusal = [&](const cv::Mat& view) { return register_view(reference, view).refusal; };
  EXPECT_EQ(refusal(Scenery(55).view({0.0, 0.0}, 2)), Refusal::kNoAgreement);
  const cv::Mat fog = Scenery::with_noise(cv::Mat(480, 640, CV_32F, cv::Scalar(150.0)), 4, 3.0);
  EXPECT_NE(refusal(fog), Refusal::kNone);
  EXPECT_EQ(register_view(fog, fog.clone()).refusal, Refusal::kNoStructure);
  EXPECT_NE(refusal(cv::Mat(480, 640, CV_8U, cv::Scalar(0))), Refusal::kNone) << "a lens cap";
  EXPECT_EQ(refusal(reference(cv::Rect(0, 0, 600, 480))), Refusal::kSize);
  EXPECT_EQ(refusal(cv::Mat()), Refusal::kSize);
}

TEST(ViewRegistration, ASmallPictureIsEnough) {
  const cv::Mat reference = scenery().view({0.0, 0.0}, 1, {}, 2.0, {320, 240});
  const cv::Mat view = scenery().view({1.3, -2.6}, 2, {}, 2.0, {320, 240});
  const ViewRegistration found = register_view(reference, view);
  ASSERT_TRUE(found) << to_string(found.refusal);
  EXPECT_LT((found.shift_px - Vector2d(1.3, -2.6)).norm(), 0.06);
}

}  // namespace
}  // namespace ols::calibration
