#include "sim/lockstep/view_tracker.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

using Eigen::Vector2d;

ViewTruth target_at(double x_px, bool visible = true, double px_per_m = 20.0) {
  ViewTruth view;
  view.visible = visible;
  view.centre_px = {x_px, 50.0};
  view.box = {x_px - 10.0, 40.0, 20.0, 20.0};
  view.px_per_m = px_per_m;
  return view;
}

// A frame of an instant; the tracker looks at no pixels.
tracker::TrackerInput at(double time_s) {
  tracker::TrackerInput input;
  input.time_s = time_s;
  return input;
}

TEST(ViewMemory, KnowsFramesByTheirExactStampAndForgetsOldOnes) {
  ViewMemory views;
  for (int i = 0; i < 101; ++i) views.add(i, target_at(i));
  EXPECT_EQ(views.at(0.0), nullptr);
  ASSERT_NE(views.at(1.0), nullptr);
  EXPECT_EQ(views.at(1.0)->centre_px.x(), 1.0);
  EXPECT_EQ(views.at(1.5), nullptr);
}

class ViewTrackerTest : public testing::Test {
 protected:
  ViewTrackerTest() {
    views_.add(1.0, target_at(100.0));
    views_.add(2.0, target_at(200.0));
    views_.add(3.0, target_at(300.0, false));
  }
  ViewMemory views_;
};

TEST_F(ViewTrackerTest, FollowsThePointOfTheTargetAtTheBoxsMiddle) {
  ViewTracker tracker(views_, 0.0, 1);
  // Pixel centres are whole numbers: the middle of this box is the pixel 103.
  ASSERT_FALSE(tracker.initialise(at(1.0), {93.5, 40.5, 20.0, 20.0}));
  const auto result = tracker.track(at(2.0));
  ASSERT_TRUE(result.output);
  EXPECT_NEAR((result.output->pixel - Vector2d(203.0, 50.0)).norm(), 0.0, 1e-12);
  views_.add(4.0, target_at(400.0, true, 40.0));  // at half the range
  EXPECT_NEAR(tracker.track(at(4.0)).output->pixel.x(), 406.0, 1e-12);
}

TEST_F(ViewTrackerTest, DoesNotBelieveInATargetOutOfThePicture) {
  ViewTracker tracker(views_, 0.0, 1);
  ASSERT_FALSE(tracker.initialise(at(1.0), {90.5, 40.5, 20.0, 20.0}));
  EXPECT_GT(tracker.track(at(2.0)).output->belief, 0.9);
  EXPECT_EQ(tracker.track(at(3.0)).output->belief, 0.0);
  EXPECT_EQ(tracker.initialise(at(3.0), {90.5, 40.5, 20.0, 20.0}), tracker::TrackerError::kBox);
}

TEST_F(ViewTrackerTest, WithoutABoxThereIsNothingToTrack) {
  ViewTracker tracker(views_, 0.0, 1);
  EXPECT_EQ(tracker.track(at(2.0)).error, tracker::TrackerError::kNotInitialised);
}

TEST_F(ViewTrackerTest, ItsNoiseIsThatOfTheStatedCovariance) {
  constexpr double kSd_px = 0.7;
  ViewTracker tracker(views_, kSd_px, 7);
  ASSERT_FALSE(tracker.initialise(at(1.0), {90.5, 40.5, 20.0, 20.0}));
  double squares = 0.0;
  constexpr int kFrames = 5000;
  for (int i = 0; i < kFrames; ++i) {
    const auto output = *tracker.track(at(2.0)).output;
    squares += (output.pixel - Vector2d(200.0, 50.0)).squaredNorm();
    ASSERT_NEAR(output.covariance_px2(0, 0), kSd_px * kSd_px, 1e-12);
  }
  EXPECT_NEAR(std::sqrt(squares / (2.0 * kFrames)), kSd_px, 0.05 * kSd_px);
}

TEST_F(ViewTrackerTest, TakesBackTheTargetThatWasSetAside) {
  ViewTracker tracker(views_, 0.0, 1);
  ASSERT_FALSE(tracker.initialise(at(1.0), {93.5, 40.5, 20.0, 20.0}));
  tracker.set_aside();
  ASSERT_FALSE(tracker.initialise(at(1.0), {80.5, 40.5, 20.0, 20.0}));
  tracker.take_back();
  EXPECT_NEAR(tracker.track(at(2.0)).output->pixel.x(), 203.0, 1e-12);
}

}  // namespace
}  // namespace ols::sim
