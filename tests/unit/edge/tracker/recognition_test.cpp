#include "edge/tracker/recognition.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::frame_at;
using testing::SyntheticScene;

constexpr double kInterval_s = 1.0 / 30.0;
const cv::Point2d kAt(300.0, 220.0);

class RecognitionTest : public ::testing::Test {
 protected:
  TrackerInput frame(int k, const std::optional<cv::Point2d>& target) {
    return frame_at(k, scene_.picture({400, 300}, target));
  }
  // A second of following `followed`, with the target in the middle of the scene, or gone.
  void follow(const Particle& followed, const std::optional<cv::Point2d>& target, int frames = 30) {
    for (int k = 1; k <= frames; ++k) {
      const TrackerInput input = frame(k, target);
      recognition_.appearance().find(input, {followed.pixel}, followed.size_px, 0.0);
      recognition_.judge(input, references_, followed, kInterval_s);
      recognition_.remember(followed, kInterval_s * k);
    }
  }
  std::optional<Particle> back(const TrackerInput& input, const Particle& followed) {
    return recognition_.return_to_sure(input, references_, followed);
  }
  // Of so many frames of a scene, in doubt.
  std::optional<Particle> back_within(int frames, const std::optional<cv::Point2d>& target) {
    for (int k = 0; k < frames; ++k) {
      if (const auto found = back(frame(62 + k, target), elsewhere_)) return found;
    }
    return std::nullopt;
  }

  SyntheticScene scene_{Backdrop::kTextured, 1};
  const cv::Rect2d box_ = SyntheticScene::box_around(kAt);
  const Particle there_{centre_of(box_), {30.0, 0.0}, size_of(box_)};
  const Particle elsewhere_{{380.0, 150.0}, {0.0, 0.0}, size_of(box_)};
  ReferenceFrames references_{0.3};
  Recognition recognition_{frame(0, kAt), centre_of(box_), size_of(box_)};
};

TEST_F(RecognitionTest, BelievesInTheTargetAndNotInTheBackground) {
  follow(there_, kAt);
  EXPECT_GT(recognition_.belief(), 0.8);
  follow(there_, std::nullopt);
  EXPECT_LT(recognition_.belief(), 0.2);
  EXPECT_TRUE(recognition_.doubts());
}

TEST_F(RecognitionTest, ReturnsToTheTargetThatItWasSureOf) {
  follow(there_, kAt);
  EXPECT_FALSE(back(frame(31, kAt), there_));  // no doubt
  follow(elsewhere_, kAt);
  const auto found = back(frame(62, kAt), elsewhere_);
  ASSERT_TRUE(found);
  EXPECT_LT((found->pixel - there_.pixel).norm(), 1.5);
  EXPECT_EQ(found->velocity_px_s, there_.velocity_px_s);
}

// A tenth of a second in doubt is enough for the target itself, not for two thirds of it.
TEST_F(RecognitionTest, ReturnsAtOnceToWhatLooksAsItDid) {
  follow(there_, kAt);
  int frames = 0;
  for (; !recognition_.doubts() && frames < 30; ++frames) follow(there_, std::nullopt, 1);
  ASSERT_LT(frames, 15);
  TrackerInput covered = frame(62, kAt);
  const cv::Rect lower(280, 222, 40, 30);
  frame(62, std::nullopt).gray(lower).copyTo(covered.gray(lower));
  EXPECT_FALSE(back(covered, elsewhere_));
  const auto found = back(frame(62, kAt), elsewhere_);
  ASSERT_TRUE(found);
  EXPECT_LT((found->pixel - there_.pixel).norm(), 1.5);
}

TEST_F(RecognitionTest, StaysWhereWhatItWasSureOfIsNowhere) {
  follow(there_, kAt);
  follow(elsewhere_, std::nullopt);
  EXPECT_FALSE(back(frame(62, std::nullopt), elsewhere_));
}

// Three boxes away from where it was seen, was followed to, or would have gone.
TEST_F(RecognitionTest, FindsFarAwayWhatItWasSureOf) {
  const cv::Point2d far(205.0, 150.0);
  follow(there_, kAt);
  follow(elsewhere_, std::nullopt);
  EXPECT_FALSE(back_within(1, far));
  const auto found = back_within(50, far);
  ASSERT_TRUE(found);
  EXPECT_LT((found->pixel - Eigen::Vector2d(far.x, far.y)).norm(), 1.5);
  EXPECT_EQ(found->velocity_px_s, Eigen::Vector2d::Zero());
}

TEST_F(RecognitionTest, FindsNothingFarAwayInTheBackground) {
  follow(there_, kAt);
  follow(elsewhere_, std::nullopt);
  EXPECT_FALSE(back_within(50, std::nullopt));
}

TEST_F(RecognitionTest, ForgetsDoubtAndMemoryWhenToldWhereTheTargetIs) {
  follow(there_, kAt);
  follow(elsewhere_, kAt);
  recognition_.restart();
  EXPECT_EQ(recognition_.belief(), 1.0);
  EXPECT_FALSE(back(frame(62, kAt), elsewhere_));
}

}  // namespace
}  // namespace ols::tracker
