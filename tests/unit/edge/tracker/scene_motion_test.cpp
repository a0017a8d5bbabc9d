#include "edge/tracker/scene_motion.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::frame_at;
using testing::kStart;
using testing::SyntheticScene;

const cv::Rect2d kBox = SyntheticScene::box_around(kStart);

SceneMotion started(const cv::Mat& gray) {
  return {TrackerConfig{}, HomographyFit::kLeastSquares, frame_at(0, gray), kBox};
}

TEST(SceneMotion, GoesByTheImageThenByThePredictionThenByNothing) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  StageTimer timer;
  SceneMotion motion = started(scene.picture({400, 300}, kStart));
  EXPECT_EQ(motion.advance(frame_at(1, scene.picture({412, 305}, kStart)), kBox, timer),
            EgoMotion::kImage);
  EXPECT_LT(
      (transform(*motion.homography(), {300.0, 200.0}) - Eigen::Vector2d(288.0, 195.0)).norm(),
      0.3);
  ASSERT_TRUE(motion.image_motion());
  EXPECT_EQ(motion.image_motion()->homography, motion.homography());
  const cv::Mat blank(480, 640, CV_8U, cv::Scalar(150));
  TrackerInput predicted = frame_at(2, blank);
  predicted.predicted_homography = testing::shift_homography(-7.0, 2.0);
  EXPECT_EQ(motion.advance(predicted, kBox, timer), EgoMotion::kPredicted);
  EXPECT_EQ(motion.homography(), predicted.predicted_homography);
  EXPECT_FALSE(motion.image_motion());
  EXPECT_EQ(motion.advance(frame_at(3, blank), kBox, timer), EgoMotion::kNone);
  EXPECT_FALSE(motion.homography());
}

// Blank sky looks the same wherever the camera turned; texture that does not match is a cut.
TEST(SceneMotion, ForgetsTheImagesOfAnotherScene) {
  SyntheticScene scene(Backdrop::kTextured, 1), sky(Backdrop::kSky, 1);
  StageTimer timer;
  for (const bool cut : {true, false}) {
    SyntheticScene& seen = cut ? scene : sky;
    SceneMotion motion = started(seen.picture({400, 300}, kStart));
    motion.advance(frame_at(1, seen.picture({400, 300}, kStart)), kBox, timer);
    EXPECT_FALSE(motion.alignment_lost());
    motion.advance(frame_at(5, seen.picture({1700, 800}, kStart)), kBox, timer);
    EXPECT_EQ(motion.alignment_lost(), cut);
    EXPECT_EQ(motion.may_be_cut(), cut);
    EXPECT_EQ(motion.unknown_a_moment_ago(), cut);
  }
}

}  // namespace
}  // namespace ols::tracker
