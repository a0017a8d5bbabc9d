#include "edge/tracker/sure_memory.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::frame_at;
using testing::SyntheticScene;

const cv::Point2d kAt(300.0, 220.0);

class SureMemoryTest : public ::testing::Test {
 protected:
  void offer(double x, double time_s) {
    memory_.offer(appearance_, {{x, 0.0}, {10.0, 0.0}, {24.0, 18.0}}, time_s);
  }

  SyntheticScene scene_{Backdrop::kTextured, 1};
  const cv::Rect2d box_ = SyntheticScene::box_around(kAt);
  const LearntAppearance appearance_{frame_at(0, scene_.picture({400, 300}, kAt)), centre_of(box_),
                                     size_of(box_)};
  SureMemory memory_;
};

TEST_F(SureMemoryTest, KnowsNothingUntilItWasSure) {
  EXPECT_EQ(memory_.recall(), nullptr);
  offer(1.0, 0.0);
  ASSERT_NE(memory_.recall(), nullptr);
  memory_.clear();
  EXPECT_EQ(memory_.recall(), nullptr);
}

TEST_F(SureMemoryTest, RecallsTheOneBeforeTheNewest) {
  offer(1.0, 0.0);
  offer(2.0, 0.2);  // too soon
  offer(3.0, 0.6);
  offer(4.0, 1.2);
  EXPECT_EQ(memory_.recall()->moving.pixel.x(), 3.0);
  EXPECT_EQ(memory_.recall()->time_s, 0.6);
}

TEST_F(SureMemoryTest, ItsTargetGoesOnOrStandsInTheScene) {
  offer(100.0, 0.0);
  MotionModel motion{TrackerConfig{}};
  motion.begin_frame({testing::shift_homography(5.0, 0.0), 0.1}, {100.0, 0.0});
  memory_.advance(motion, SyntheticScene::kSize);
  EXPECT_NEAR(memory_.recall()->moving.pixel.x(), 100.0 + 5.0 + 1.0, 1e-9);
  EXPECT_NEAR(memory_.recall()->still.pixel.x(), 100.0 + 5.0, 1e-9);
}

}  // namespace
}  // namespace ols::tracker
