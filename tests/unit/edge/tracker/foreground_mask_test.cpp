#include "edge/tracker/foreground_mask.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::shift_homography;
using testing::SyntheticScene;

TEST(ForegroundMask, ShowsTheTargetByAnEarlierAlignedImage) {
  SyntheticScene scene(Backdrop::kTextured, 6);
  const cv::Point2d then(100.0, 100.0);
  const cv::Point2d now(300.0, 240.0);
  ReferenceFrames references(0.1);
  references.offer(scene.picture({400, 300}, then), 0.0, SyntheticScene::box_around(then));
  references.advance(shift_homography(-20.0, 5.0));
  const cv::Mat frame = scene.picture({420, 295}, now);
  const cv::Rect2d box = SyntheticScene::box_around(now);
  EXPECT_EQ(references.without_overlap(SyntheticScene::box_around({80.0, 105.0})), nullptr);
  const auto* reference = references.without_overlap(box);
  ASSERT_NE(reference, nullptr);
  Template target;
  target.contrast = 100.0F;
  target.noise = 3.0F;
  const FrameView mask = foreground_mask(frame, *reference, cv::Rect(200, 150, 200, 180), target);
  const MaskPatch at_target = sample_mask(mask, {now.x, now.y}, {12.0, 8.0});
  const MaskPatch beside = sample_mask(mask, {now.x - 60.0, now.y}, {12.0, 8.0});
  const auto mean = [](const MaskPatch& patch) {
    double sum = 0.0;
    for (const auto value : patch) sum += value;
    return sum / kPatchArea;
  };
  EXPECT_GT(mean(at_target), 150.0);
  EXPECT_LT(mean(beside), 40.0);
}

TEST(ReferenceFrames, RememberWhatIsBehindATargetThatStands) {
  ReferenceFrames references(0.3);
  const cv::Mat gray(100, 100, CV_8UC1, cv::Scalar(7));
  const cv::Rect2d before(5.0, 5.0, 10.0, 10.0), stands(60.0, 60.0, 10.0, 10.0);
  references.offer(gray, 0.0, before);
  for (int k = 1; k < 30; ++k) references.offer(gray, 0.4 * k, stands);
  const auto* behind = references.without_overlap(stands);
  ASSERT_NE(behind, nullptr);
  EXPECT_EQ(behind->time_s, 0.0);
  ASSERT_NE(references.older_than(29 * 0.4), nullptr);
  EXPECT_NEAR(references.older_than(29 * 0.4)->time_s, 29 * 0.4, 1e-9);
}

}  // namespace
}  // namespace ols::tracker
