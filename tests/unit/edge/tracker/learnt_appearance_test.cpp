#include "edge/tracker/learnt_appearance.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::frame_at;
using testing::SyntheticScene;

TEST(LearntAppearance, FindsItsTargetAndNotTheBackground) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  const cv::Point2d at(300.0, 220.0);
  const cv::Rect2d box = SyntheticScene::box_around(at);
  LearntAppearance appearance(frame_at(0, scene.picture({400, 300}, at)), centre_of(box),
                              size_of(box));
  const TrackerInput there = frame_at(1, scene.picture({400, 300}, at));
  const auto found = appearance.find(there, {{200.0, 150.0}, {306.0, 215.0}}, size_of(box), 0.5);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - centre_of(box)).norm(), 1.5);
  EXPECT_GT(appearance.recognised(*found), 0.6);
  const TrackerInput gone = frame_at(2, scene.picture({400, 300}, std::nullopt));
  EXPECT_FALSE(appearance.find(gone, {centre_of(box)}, size_of(box), 0.35));
}

TEST(LearntAppearance, ATargetIsProminentAndTheBackgroundIsNot) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  const cv::Point2d at(300.0, 220.0);
  const cv::Rect2d box = SyntheticScene::box_around(at);
  LearntAppearance appearance(frame_at(0, scene.picture({400, 300}, at)), centre_of(box),
                              size_of(box));
  const auto prominence = [&](const std::optional<cv::Point2d>& target) {
    appearance.find(frame_at(1, scene.picture({400, 300}, target)), {centre_of(box)}, size_of(box),
                    0.0);
    return appearance.prominence(centre_of(box));
  };
  EXPECT_GT(prominence(at), 24.0);
  EXPECT_LT(prominence(std::nullopt), 8.0);
}

}  // namespace
}  // namespace ols::tracker
