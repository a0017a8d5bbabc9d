#include "edge/tracker/target_model.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::kStart;
using testing::SyntheticScene;

TEST(TargetModel, TellsTheTargetFromTheSkyBesideIt) {
  SyntheticScene pictures(Backdrop::kSky, 2);
  const cv::Rect2d box = SyntheticScene::box_around(kStart);
  const cv::Mat gray = pictures.picture({400, 300}, kStart);
  const TargetModel target(TrackerConfig{}, gray, box);
  EXPECT_FALSE(target.empty());
  Scene scene = target.make_scene(gray, {}, box, ReferenceFrames(0.3));
  EXPECT_FALSE(scene.mask_by_subtraction);
  scene.background_similarity = target.background_similarity(scene, box);
  EXPECT_GT(scene.background_similarity, 0.0);
  const Particle here{centre_of(box), {0.0, 0.0}, size_of(box)};
  Particle beside = here;
  beside.pixel.x() += 40.0;
  const FrameEvidence good = target.evidence(scene, here), bad = target.evidence(scene, beside);
  EXPECT_GT(good.correlation, 0.95);
  EXPECT_NEAR(good.standing_out, 1.0, 0.1);
  EXPECT_EQ(good.background_similarity, scene.background_similarity);
  EXPECT_LT(bad.correlation, 0.3);
  EXPECT_LT(bad.standing_out, 0.2);
  EXPECT_GT(frame_belief(good, {}), 0.9);
  EXPECT_LT(frame_belief(bad, {}), 0.1);
  const auto log_likelihood = [&](const Particle& at) {
    return target.log_likelihood(target.likeness(scene, at.pixel, at.size_px),
                                 scene.background_similarity,
                                 target.standing_out(scene, at.pixel, at.size_px), at.size_px);
  };
  EXPECT_GT(log_likelihood(here), log_likelihood(beside) + 10.0);
}

TEST(TargetModel, IsEmptyWhereNothingStandsOut) {
  SyntheticScene pictures(Backdrop::kSky, 2);
  const TargetModel target(TrackerConfig{}, pictures.picture({400, 300}, std::nullopt),
                           SyntheticScene::box_around(kStart));
  EXPECT_TRUE(target.empty());
}

TEST(TargetModel, LearnsAShareOfTheContrastThatItSees) {
  SyntheticScene pictures(Backdrop::kSky, 2);
  const cv::Rect2d box = SyntheticScene::box_around(kStart);
  const cv::Mat gray = pictures.picture({400, 300}, kStart);
  cv::Mat faint;  // half the contrast, before the sky's level of 150
  gray.convertTo(faint, CV_8U, 0.5, 75.0);
  for (const auto& [share, expected] : {std::pair(0.5, 0.5 / 0.75), std::pair(1.0, 1.0)}) {
    TargetModel target(TrackerConfig{}, gray, box);
    const Scene scene = target.make_scene(faint, {}, box, ReferenceFrames(0.3));
    const auto standing_out = [&] {
      return target.standing_out(scene, centre_of(box), size_of(box));
    };
    EXPECT_NEAR(standing_out(), 0.5, 0.03);
    target.learn(scene, centre_of(box), size_of(box), share);
    EXPECT_NEAR(standing_out(), expected, 0.03);
  }
}

// Where its view is a part of the picture.
TEST(TargetModel, LooksThreeBoxesFarToEverySideOfALargeTarget) {
  SyntheticScene pictures(Backdrop::kTextured, 2);
  const cv::Mat gray = pictures.picture({400, 300}, kStart);
  const cv::Rect2d box(270.0, 210.0, 60.0, 48.0);
  const TargetModel target(TrackerConfig{}, gray, box);
  const FrameView view = target.make_scene(gray, {}, box, ReferenceFrames(0.3)).view;
  ASSERT_EQ(view.reduction, 2);
  EXPECT_NEAR(view.origin.x, 270.0 - 180.0, 2.0);
  EXPECT_NEAR(view.origin.y, 210.0 - 144.0, 2.0);
  EXPECT_NEAR(view.image.cols * 2, 7.0 * 60.0, 4.0);
  EXPECT_NEAR(view.image.rows * 2, 7.0 * 48.0, 4.0);
}

}  // namespace
}  // namespace ols::tracker
