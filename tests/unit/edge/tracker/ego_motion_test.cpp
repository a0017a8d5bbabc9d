#include "edge/tracker/ego_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "edge/tracker/particle.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::shift_homography;
using testing::SyntheticScene;

TEST(EgoMotion, MeasuresTheShiftOfTexture) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  EgoMotionEstimator ego(TrackerConfig{}, HomographyFit::kLeastSquares);
  ego.start(reduce_frame(scene.picture({400, 300}, std::nullopt), 640));
  const auto estimate = ego.step(reduce_frame(scene.picture({412.5, 295}, std::nullopt), 640),
                                 cv::Rect2d(), std::nullopt);
  ASSERT_TRUE(estimate.motion.has_value());
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(20, 20), Eigen::Vector2d(600, 400)}) {
    const Eigen::Vector2d moved = transform(estimate.motion->homography, pixel) - pixel;
    EXPECT_NEAR(moved.x(), -12.5, 0.3);
    EXPECT_NEAR(moved.y(), 5.0, 0.3);
  }
}

// Corners are followed for some frames, while they leave the picture, and then looked for anew.
TEST(EgoMotion, MeasuresOnWhileTheCameraTurnsOn) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  EgoMotionEstimator ego(TrackerConfig{}, HomographyFit::kLeastSquares);
  cv::Point2d camera(200.0, 300.0);
  ego.start(reduce_frame(scene.picture(camera, std::nullopt), 640));
  for (int frame = 1; frame <= 25; ++frame) {
    const cv::Point2d turned(std::min(5.0 * frame, 35.0), 2.5);
    camera += turned;
    const auto estimate = ego.step(reduce_frame(scene.picture(camera, std::nullopt), 640),
                                   cv::Rect2d(), std::nullopt);
    ASSERT_TRUE(estimate.motion.has_value()) << frame;
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(40, 20), Eigen::Vector2d(600, 460)}) {
      const Eigen::Vector2d moved = transform(estimate.motion->homography, pixel) - pixel;
      EXPECT_NEAR(moved.x(), -turned.x, 0.3) << frame;
      EXPECT_NEAR(moved.y(), -turned.y, 0.3) << frame;
    }
  }
}

TEST(EgoMotion, FindsAFastTurnFromThePrediction) {
  SyntheticScene scene(Backdrop::kTextured, 2);
  EgoMotionEstimator ego(TrackerConfig{}, HomographyFit::kLeastSquares);
  ego.start(reduce_frame(scene.picture({400, 300}, std::nullopt), 640));
  const auto estimate = ego.step(reduce_frame(scene.picture({600, 300}, std::nullopt), 640),
                                 cv::Rect2d(), shift_homography(-196.0, 2.0));
  ASSERT_TRUE(estimate.motion.has_value());
  EXPECT_NEAR(transform(estimate.motion->homography, {400, 200}).x(), 200.0, 0.3);
}

TEST(EgoMotion, HasNoneBeforeBlankSky) {
  SyntheticScene scene(Backdrop::kSky, 3, 0.0);
  EgoMotionEstimator ego(TrackerConfig{}, HomographyFit::kLeastSquares);
  ego.start(reduce_frame(scene.picture({400, 300}, std::nullopt), 640));
  const auto estimate = ego.step(reduce_frame(scene.picture({400, 300}, std::nullopt), 640),
                                 cv::Rect2d(), std::nullopt);
  EXPECT_FALSE(estimate.motion.has_value());
  EXPECT_TRUE(estimate.featureless);
}

// Corners on a strip of ground say nothing of the sky: the fit must not fling it about.
TEST(EgoMotion, FitFromAStripStaysCalmElsewhere) {
  cv::RNG random(4);
  std::vector<cv::Point2f> previous;
  std::vector<cv::Point2f> current;
  for (int i = 0; i < 40; ++i) {
    const cv::Point2f p(random.uniform(0.0F, 640.0F), random.uniform(440.0F, 470.0F));
    previous.push_back(p);
    current.push_back(p + cv::Point2f(8.0F + static_cast<float>(random.gaussian(0.3)),
                                      -3.0F + static_cast<float>(random.gaussian(0.3))));
  }
  const Eigen::Matrix3d fitted =
      fit_homography(previous, current, Eigen::Matrix3d::Identity(), {640, 480});
  const Eigen::Vector2d sky = transform(fitted, {320, 50});
  EXPECT_NEAR(sky.x(), 328.0, 3.0);
  EXPECT_NEAR(sky.y(), 47.0, 3.0);
}

// A strip that shears tells of the rest of the picture what no camera does: the paper takes
// RANSAC's word for it, the fit by least squares does not.
TEST(EgoMotion, IsRansacsOwnWhereThatIsAskedFor) {
  cv::Mat before = SyntheticScene(Backdrop::kTextured, 3).picture({400, 300}, std::nullopt);
  before.rowRange(0, 210).setTo(150);
  before.rowRange(270, 480).setTo(150);
  const cv::Mat shear = (cv::Mat_<double>(2, 3) << 1.0, 0.03, -7.2, 0.0, 1.0, 0.0);
  cv::Mat after;
  cv::warpAffine(before, after, shear, before.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  for (const HomographyFit fit : {HomographyFit::kRansac, HomographyFit::kLeastSquares}) {
    EgoMotionEstimator estimator(TrackerConfig{}, fit);
    estimator.start(reduce_frame(before, 640));
    const auto found = estimator.step(reduce_frame(after, 640), {}, std::nullopt).motion;
    ASSERT_TRUE(found.has_value());
    const double off_px = std::abs(transform(found->homography, {320.0, 0.0}).x() - (320.0 - 7.2));
    EXPECT_EQ(off_px < 1.5, fit == HomographyFit::kRansac) << off_px;
  }
}

TEST(EgoMotion, TellsSenselessHomographies) {
  EXPECT_TRUE(plausible_homography(shift_homography(50, 20), {640, 480}));
  EXPECT_FALSE(plausible_homography(shift_homography(5000, 0), {640, 480}));
  EXPECT_FALSE(plausible_homography(Eigen::Matrix3d::Zero(), {640, 480}));
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(0, 0) = -1.0;
  EXPECT_FALSE(plausible_homography(mirror, {640, 480}));
  for (const int side : {0, 1}) {
    Eigen::Matrix3d tilted = Eigen::Matrix3d::Identity();
    tilted(2, side) = 1e-4;
    EXPECT_TRUE(plausible_homography(tilted, {640, 480})) << side;
    tilted(2, side) = -1e-3;
    EXPECT_FALSE(plausible_homography(tilted, {640, 480})) << side;
  }
}

}  // namespace
}  // namespace ols::tracker
