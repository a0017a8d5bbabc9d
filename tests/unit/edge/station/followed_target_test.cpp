#include "edge/station/followed_target.h"

#include <gtest/gtest.h>

#include <memory>

#include "station_fixture.h"

namespace ols::station {
namespace {

using Dropped = FollowedTarget::Dropped;

camera::Frame frame_at(double time_s) {
  camera::Frame frame;
  frame.mid_exposure_s = time_s;
  return frame;
}

class FollowedTargetTest : public testing::Test {
 protected:
  static constexpr double kTrial_s = 1.0;

  StationConfig config_;
  test::ScriptedTracker::Script script_;
  FollowedTarget target_{config_, std::make_unique<test::ScriptedTracker>(script_)};
  PointingModel pointing_{config_};
  cv::Rect2d box_{10, 10, 20, 20};
};

TEST_F(FollowedTargetTest, ARefusedDesignationChangesNothing) {
  script_.accept = false;
  EXPECT_TRUE(target_.designate(frame_at(1.0), box_));
  EXPECT_FALSE(target_.exists());
  script_.accept = true;
  EXPECT_FALSE(target_.designate(frame_at(2.0), box_));
  script_.accept = false;
  EXPECT_TRUE(target_.designate(frame_at(3.0), box_));
  EXPECT_TRUE(target_.exists());
  EXPECT_EQ(target_.track_id(), 1);
}

TEST_F(FollowedTargetTest, ATrialThatLastsTooLongReturnsToTheOwnTarget) {
  target_.designate(frame_at(1.0), box_);
  ASSERT_TRUE(target_.try_found(frame_at(5.0), box_));
  EXPECT_EQ(script_.set_aside, 1);
  EXPECT_TRUE(target_.on_trial());
  EXPECT_EQ(target_.track_id(), 2);
  EXPECT_EQ(target_.drop_unproven(5.0 + 0.9 * kTrial_s), Dropped::kNothing);
  EXPECT_EQ(target_.drop_unproven(5.0 + kTrial_s), Dropped::kBackToOwn);
  EXPECT_EQ(script_.taken_back, 1);
  EXPECT_FALSE(target_.on_trial());
  EXPECT_EQ(target_.track_id(), 1);
  EXPECT_EQ(target_.drop_unproven(100.0), Dropped::kNothing);
}

TEST_F(FollowedTargetTest, WithoutAnOwnTargetAFailedTrialLeavesNone) {
  ASSERT_TRUE(target_.try_found(frame_at(5.0), box_));
  EXPECT_EQ(script_.set_aside, 0);
  EXPECT_EQ(target_.drop_unproven(5.0 + kTrial_s), Dropped::kNothingLeft);
  EXPECT_FALSE(target_.exists());
}

TEST_F(FollowedTargetTest, ATrackIdIsNeverUsedForTwoObjects) {
  target_.designate(frame_at(1.0), box_);
  target_.try_found(frame_at(5.0), box_);
  target_.drop_unproven(5.0 + kTrial_s);
  target_.designate(frame_at(7.0), box_);
  EXPECT_EQ(target_.track_id(), 3) << "the id of the failed trial is not used again";
}

TEST_F(FollowedTargetTest, WhatTheTrackerRefusesToTryIsNoTrial) {
  target_.designate(frame_at(1.0), box_);
  script_.accept = false;
  EXPECT_FALSE(target_.try_found(frame_at(5.0), box_));
  EXPECT_EQ(script_.taken_back, 1);
  EXPECT_FALSE(target_.on_trial());
  EXPECT_EQ(target_.track_id(), 1);
  EXPECT_FALSE(target_.counters().contains("acquisitions"));
}

TEST_F(FollowedTargetTest, AConfirmedTargetIsTheOwnOne) {
  target_.designate(frame_at(1.0), box_);
  target_.try_found(frame_at(5.0), box_);
  target_.confirm();
  EXPECT_FALSE(target_.on_trial());
  EXPECT_EQ(target_.drop_unproven(100.0), Dropped::kNothing);
  EXPECT_EQ(target_.track_id(), 2);
}

TEST_F(FollowedTargetTest, TheBoxIsAsGoodAsItsOrigin) {
  target_.designate(frame_at(1.0), box_);
  EXPECT_EQ(target_.centring_sd_px(), config_.designation_sd_px);
  target_.try_found(frame_at(5.0), box_);
  target_.confirm();
  EXPECT_EQ(target_.centring_sd_px(), config_.acquisition_sd_px) << "also when it is confirmed";
}

TEST_F(FollowedTargetTest, ItsCentreIsFixedOnATargetThatComesNearer) {
  target_.designate(frame_at(1.0), box_);
  script_.size_px = 3.0 * box_.width;
  target_.track(frame_at(1.1), pointing_);
  EXPECT_DOUBLE_EQ(target_.centring_sd_px(), 3.0 * config_.designation_sd_px);
  target_.try_found(frame_at(5.0), {0, 0, 60, 60});
  target_.drop_unproven(5.0 + kTrial_s);
  target_.track(frame_at(6.1), pointing_);
  EXPECT_DOUBLE_EQ(target_.centring_sd_px(), 3.0 * config_.designation_sd_px)
      << "the size of another's box says nothing of the own target";
}

TEST_F(FollowedTargetTest, OnlyConsecutiveFramesContradictTheAngles) {
  target_.designate(frame_at(0.0), box_);
  double now_s = 0.0;
  const auto frames = [&](int count, std::optional<double> error_px) {
    script_.prediction_error_px = error_px;
    for (int i = 0; i < count; ++i) target_.track(frame_at(now_s += 0.1), pointing_);
  };
  frames(config_.disagreeing_frames - 1, config_.prediction_error_px + 1.0);
  EXPECT_FALSE(target_.motion_disagrees());
  frames(3, std::nullopt);  // not measured: neither for nor against
  frames(1, config_.prediction_error_px + 1.0);
  EXPECT_TRUE(target_.motion_disagrees());
  frames(1, config_.prediction_error_px);
  EXPECT_FALSE(target_.motion_disagrees());
}

TEST_F(FollowedTargetTest, AnglesPredictTheImageUntilTheyAreForgotten) {
  for (const double time_s : {0.0, 0.1, 0.2, 0.3, 0.4}) {
    pointing_.add({.time_s = time_s, .time_sd_s = 1e-4, .angles = {0.1 * time_s, 0.0}});
  }
  target_.designate(frame_at(0.05), box_);
  target_.track(frame_at(0.15), pointing_);
  ASSERT_TRUE(script_.last->predicted_homography);
  EXPECT_FALSE(script_.last->predicted_homography->isIdentity(1e-6));
  target_.forget_angles();
  target_.track(frame_at(0.25), pointing_);
  EXPECT_FALSE(script_.last->predicted_homography) << "the frames are not of one reference";
  target_.track(frame_at(0.35), pointing_);
  EXPECT_TRUE(script_.last->predicted_homography);
}

TEST_F(FollowedTargetTest, TheTrackerSeesTheColoursOfTheCamera) {
  camera::Frame frame = frame_at(0.0);
  frame.raw = cv::Mat(8, 8, CV_8UC1, cv::Scalar(7));
  frame.pixel_format = "BayerGB8";
  target_.designate(frame, box_);
  frame.mid_exposure_s = 0.1;
  target_.track(frame, pointing_);
  ASSERT_TRUE(script_.last);
  EXPECT_EQ(script_.last->colour.image.data, frame.raw.data) << "not a copy";
  EXPECT_EQ(script_.last->colour.layout, tracker::ColourLayout::kBayerGb);
  frame.mid_exposure_s = 0.2;
  frame.pixel_format = "Mono12";  // deeper than 8 bit, and no colours
  target_.track(frame, pointing_);
  EXPECT_TRUE(script_.last->colour.empty());
}

}  // namespace
}  // namespace ols::station
