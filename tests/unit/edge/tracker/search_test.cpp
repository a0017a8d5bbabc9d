// What a tracker may believe in when the picture no longer goes on as it did.
#include <gtest/gtest.h>

#include "edge/tracker/belief.h"
#include "edge/tracker/foreground_mask.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace ols {
namespace {

using testing::Backdrop;
using testing::SyntheticScene;

constexpr double kInterval_s = 1.0 / 15.0;

// A dark post, alike in size and darkness, not in shape.
cv::Mat with_post(cv::Mat gray) {
  cv::rectangle(gray, cv::Rect(495, 138, 12, 26), cv::Scalar(60), cv::FILLED);
  return gray;
}

TEST(Search, DoesNotTakeAPostForTheTargetAfterACut) {
  SyntheticScene scene(Backdrop::kTextured, 21);
  Tracker tracker(TrackerConfig{}, 5);
  const cv::Point2d start(300.0, 220.0);
  const auto input = [](int k, const cv::Mat& gray) {
    return TrackerInput{gray, kInterval_s * k, std::nullopt};
  };
  ASSERT_FALSE(tracker.initialise(input(0, scene.picture({400, 300}, start)),
                                  SyntheticScene::box_around(start)));
  for (int k = 1; k < 20; ++k) {
    const cv::Point2d truth(300.0 + 2.0 * k, 220.0);
    EXPECT_GT(tracker.track(input(k, scene.picture({400, 300}, truth))).output->belief, 0.8) << k;
  }
  for (int k = 20; k < 60; ++k) {
    const cv::Mat elsewhere = with_post(scene.picture({1700, 800}, std::nullopt));
    const double belief = tracker.track(input(k, elsewhere)).output->belief;
    if (k >= 25) {
      EXPECT_LT(belief, 0.5) << k;
    }
  }
}

TEST(Search, RemembersWhatIsBehindATargetThatStands) {
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

TEST(Search, UsualIsWhatTheTargetHasLookedLikeOfLate) {
  Belief steady, varied;
  steady.start();
  varied.start();
  FrameEvidence seen{0.8, 0.3, 0.95, 1.0};
  for (int k = 0; k < 100; ++k) {
    steady.update(seen, kInterval_s);
    FrameEvidence beating = seen;
    beating.correlation = k % 2 == 0 ? 0.95 : 0.7;
    varied.update(beating, kInterval_s);
  }
  FrameEvidence other = seen;
  other.correlation = 0.7;
  EXPECT_FALSE(steady.usual(other));
  EXPECT_TRUE(varied.usual(other));
  EXPECT_TRUE(steady.usual(seen));
  other = seen;
  other.standing_out = 0.2;
  EXPECT_FALSE(varied.usual(other));
}

}  // namespace
}  // namespace ols
