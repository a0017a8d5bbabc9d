#include "edge/tracker/learnt_appearance.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

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

// The same scene in colour: everything grey but a target of one colour.
TrackerInput coloured(TrackerInput frame, const cv::Rect2d& box, const cv::Scalar& colour) {
  cv::cvtColor(frame.gray, frame.colour.image, cv::COLOR_GRAY2BGR);
  frame.colour.image(cv::Rect(box)).setTo(colour);
  return frame;
}

class ColouredAppearance : public ::testing::Test {
 protected:
  TrackerInput there(int k, const cv::Point2d& at, const cv::Scalar& colour) {
    return coloured(frame_at(k, scene_.picture({400, 300}, at)), SyntheticScene::box_around(at),
                    colour);
  }

  const cv::Point2d at_{300.0, 220.0};
  const cv::Scalar red_{20, 20, 200}, green_{20, 200, 20};
  SyntheticScene scene_{Backdrop::kTextured, 1};
  const cv::Rect2d box_ = SyntheticScene::box_around(at_);
};

// In a picture of one grey level the filter has nothing to respond to.
TEST_F(ColouredAppearance, IsRecognisedByItsColoursToo) {
  LearntAppearance appearance(there(0, at_, red_), centre_of(box_), size_of(box_));
  const auto recognised = [&](const cv::Scalar& bgr) {
    TrackerInput plain = there(1, at_, bgr);
    plain.gray.setTo(100);
    appearance.find(plain, {centre_of(box_)}, size_of(box_), 0.0);
    return appearance.recognised(centre_of(box_));
  };
  EXPECT_GT(recognised(red_), 0.25);
  EXPECT_LT(recognised(green_), 0.05);
}

TEST_F(ColouredAppearance, LearnsLittleOfABoxInOtherColours) {
  LearntAppearance appearance(there(0, at_, red_), centre_of(box_), size_of(box_));
  TrackerInput other = there(1, at_, green_);
  other.gray = 255 - other.gray;
  const auto prominence = [&] {
    appearance.find(other, {centre_of(box_)}, size_of(box_), 0.0);
    return appearance.prominence(centre_of(box_));
  };
  const double before = prominence();
  appearance.learn(other, centre_of(box_), size_of(box_), 1.0 / 30.0);
  EXPECT_LT(prominence(), before + 2.0);
}

TEST_F(ColouredAppearance, KnowsItsFirstColoursHoweverLongItLearnsOthers) {
  LearntAppearance appearance(there(0, at_, red_), centre_of(box_), size_of(box_));
  const auto colours = [&](const cv::Scalar& bgr) {
    appearance.find(there(1, at_, bgr), {centre_of(box_)}, size_of(box_), 0.0);
    return appearance.first_colours(centre_of(box_));
  };
  const auto learn = [&](const cv::Scalar& bgr, int frames) {
    for (int k = 0; k < frames; ++k) {
      const TrackerInput frame = there(k, at_, bgr);
      appearance.find(frame, {centre_of(box_)}, size_of(box_), 0.0);
      appearance.learn(frame, centre_of(box_), size_of(box_), 1.0 / 30.0);
    }
  };
  learn(red_, 16);
  EXPECT_GT(appearance.first_separability(centre_of(box_)), 0.6);
  EXPECT_GT(colours(red_), 0.8);
  EXPECT_LT(colours(green_), 0.2);
  learn(green_, 60);
  EXPECT_GT(colours(red_), 0.8);
  EXPECT_LT(colours(green_), 0.2);
}

TEST_F(ColouredAppearance, IsRecognisedInAnotherExposure) {
  LearntAppearance appearance(there(0, at_, red_), centre_of(box_), size_of(box_));
  TrackerInput darker = there(1, at_, red_);
  darker.gray *= 0.6;
  darker.colour.image *= 0.6;
  appearance.find(darker, {centre_of(box_)}, size_of(box_), 0.0);
  EXPECT_GT(appearance.recognised(centre_of(box_)), 0.6);
  EXPECT_GT(appearance.first_colours(centre_of(box_)), 0.7);
}

// The surroundings have the target's grey, too: once the picture is darker, they have more of it.
TEST_F(ColouredAppearance, ColoursThatFitNowhereDoNotCountAgainstTheFilter) {
  const cv::Scalar grey(150, 150, 150);
  LearntAppearance appearance(there(0, at_, grey), centre_of(box_), size_of(box_));
  TrackerInput darker = there(0, at_, grey);
  darker.colour.image *= 0.6;
  appearance.find(darker, {centre_of(box_)}, size_of(box_), 0.0);
  EXPECT_GT(appearance.recognised(centre_of(box_)), 0.6) << "else it is never learnt again";
}

TEST_F(ColouredAppearance, AGreyPictureSaysNothingOfColours) {
  LearntAppearance appearance(there(0, at_, red_), centre_of(box_), size_of(box_));
  TrackerInput grey = there(1, at_, red_);
  appearance.find(grey, {centre_of(box_)}, size_of(box_), 0.0);
  EXPECT_GT(appearance.first_separability(centre_of(box_)), 0.5);
  grey.colour = {};
  appearance.find(grey, {centre_of(box_)}, size_of(box_), 0.0);
  EXPECT_EQ(appearance.first_separability(centre_of(box_)), 0.0);
}

}  // namespace
}  // namespace ols::tracker
