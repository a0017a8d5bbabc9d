#include "edge/station/station.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "geometry/angles.h"
#include "geometry/sight.h"
#include "geometry/wgs84.h"
#include "station_fixture.h"

namespace ols::station {
namespace {

using test::StationTest;

TEST_F(StationTest, IsIdleAndSendsNothing) {
  run_until(101.0);
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_TRUE(bearings_.empty());
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(script_.tracked, 0);
}

TEST_F(StationTest, TracksAfterDesignationAndSendsBearingsAlongTheAxis) {
  designated_for(1.0);
  EXPECT_EQ(station_.state(), StationState::kTracking);
  ASSERT_GE(bearings_.size(), 13u);
  const Bearing& bearing = bearings_.back();
  EXPECT_NEAR(degrees(bearing.sight.direction.azimuth_rad), 30.0, 1e-4);
  EXPECT_NEAR(degrees(bearing.sight.direction.elevation_rad), 0.0, 1e-4);
  EXPECT_EQ(bearing.track_id, 1);
  // White: half a pixel of 75 urad; systematic: heading 0.02 deg and a pixel of designation.
  EXPECT_NEAR(std::sqrt(bearing.sight.covariance_white(0, 0)), 37.5e-6, 30e-6);
  EXPECT_NEAR(std::sqrt(bearing.sight.covariance_systematic(0, 0)),
              std::hypot(radians(0.02), 75e-6), 1e-6);
}

TEST_F(StationTest, AViewerSeesTheBoxOfThisVeryFrameAndWhereTheCameraLooks) {
  designated();
  run_until(now_ + 0.5, true, cv::Mat(4, 4, CV_8U, cv::Scalar(9)));
  ASSERT_TRUE(script_.last);
  const double seen_s = script_.last->time_s;
  const auto frame = station_.video_frame(seen_s);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->gray.at<std::uint8_t>(0, 0), 9);
  EXPECT_EQ(frame->track_id, 1);
  ASSERT_TRUE(frame->box);
  EXPECT_EQ(frame->belief, script_.belief);
  ASSERT_TRUE(frame->camera);
  // A point 1 km away on the bearing lies on the optical axis.
  const auto axis = enu_from_azimuth_elevation({radians(30.0), 0.0});
  const Eigen::Vector3d point =
      frame->camera->centre_ecef + 1000.0 * (R_ecef_enu(frame->camera->centre_ecef) * axis);
  const Eigen::Vector3d in_camera =
      frame->camera->R_camera_ecef * (point - frame->camera->centre_ecef);
  EXPECT_TRUE(in_camera.isApprox(Eigen::Vector3d(0.0, 0.0, 1000.0), 1e-5)) << in_camera;
}

TEST_F(StationTest, ABearingHasTheTimeOfItsRow) {
  designated();
  row_readout_s_ = 0.03;
  bearings_.clear();
  run_until(now_ + 0.2, true, cv::Mat::zeros(960, 1280, CV_8U));
  ASSERT_FALSE(bearings_.empty());
  const Bearing& bearing = bearings_.back();
  ASSERT_GT(bearing.pixel.y(), 1.0);
  const double frames =
      (frame_s_ - bearing.mid_exposure_s + 0.03 * bearing.pixel.y() / 960) / 0.005;
  EXPECT_NEAR(frames, std::round(frames), 1e-6) << "frames come in turns of 5 ms";
}

TEST_F(StationTest, AViewerGetsNoFrameThatTheStationRefused) {
  designated();
  EXPECT_FALSE(station_.video_frame(now_ + 1.0));
}

TEST_F(StationTest, WithoutATargetAViewerSeesNoBox) {
  run_until(101.0);
  camera::Frame frame;
  frame.mid_exposure_s = now_;
  station_.on_frame(frame, now_);
  const auto shown = station_.video_frame(now_);
  ASSERT_TRUE(shown);
  EXPECT_FALSE(shown->box);
}

TEST_F(StationTest, ANewDesignationIsANewTrack) {
  designated();
  designated_for(0.3);
  EXPECT_EQ(bearings_.back().track_id, 2);
}

TEST_F(StationTest, DesignationInThePastCatchesUp) {
  run_until(101.0);
  const double meant = now_ - 0.5;
  // The test's frames were exposed 20 ms before they came, every 70 ms or so: find one by trial.
  Refusal result = Refusal::kNoFrame;
  for (double t = meant; t < meant + 0.07 && result != Refusal::kNone; t += 0.01) {
    result = station_.designate({t, {629, 469, 20, 20}}, now_);
  }
  ASSERT_EQ(result, Refusal::kNone);
  EXPECT_GE(script_.tracked, 5);
  run_until(now_ + 0.1);
  EXPECT_GE(bearings_.size(), 5u);
}

TEST_F(StationTest, DesignationOfAFrameLongGoneIsRefused) {
  run_until(103.0);
  EXPECT_EQ(station_.designate({100.5, {629, 469, 20, 20}}, now_), Refusal::kNoFrame);
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_EQ(station_.snapshot().counters.at("refused_no_frame"), 1.0);
}

TEST_F(StationTest, DesignationThatTheTrackerRefusesChangesNothing) {
  run_until(100.5);
  script_.accept = false;
  EXPECT_EQ(station_.designate({std::nullopt, {0, 0, 1, 1}}, now_), Refusal::kBox);
  EXPECT_EQ(station_.state(), StationState::kIdle);
}

TEST_F(StationTest, CoastsThenLosesThenHalts) {
  designated_for(0.5);
  script_.belief = 0.1;
  run_until(now_ + 0.2);
  EXPECT_EQ(station_.state(), StationState::kCoasting);
  EXPECT_TRUE(station_.goal(now_));
  const std::size_t before = bearings_.size();
  run_until(now_ + config().coast_s + 0.2);
  EXPECT_EQ(station_.state(), StationState::kLost);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(bearings_.size(), before) << "no bearing without belief";
}

TEST_F(StationTest, ReturnsFromCoastingAtOnce) {
  designated_for(0.5);
  script_.belief = 0.1;
  run_until(now_ + 0.2);
  script_.belief = 0.9;
  run_until(now_ + 0.1);
  EXPECT_EQ(station_.state(), StationState::kTracking);
}

TEST_F(StationTest, LosesTheTargetWhenTheFramesStop) {
  designated_for(0.5);
  run_until(now_ + config().coast_s + 0.3, false);
  EXPECT_EQ(station_.state(), StationState::kLost);
  EXPECT_FALSE(station_.goal(now_));
}

TEST_F(StationTest, GoalOfATargetOffTheAxisLeadsThere) {
  script_.pixel = {639.5 + 100.0, 479.5};  // to the right: pan is positive to the left
  designated_for(0.5);
  const auto goal = station_.goal(now_);
  ASSERT_TRUE(goal);
  EXPECT_NEAR(goal->angles.pan_rad, -100.0 * 75e-6, 2e-6);
  EXPECT_NEAR(goal->rate.pan_rad, 0.0, 1e-4);
}

TEST_F(StationTest, TheOperatorHasPrecedenceOverSlews) {
  run_until(100.5);
  ASSERT_EQ(station_.point({{0.2, 0.1}}, now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kManual);
  EXPECT_NEAR(station_.goal(now_)->angles.pan_rad, 0.2, 1e-12);
  EXPECT_EQ(station_.slew(slew(20.0), now_), Refusal::kPrecedence);
  station_.stop(now_);
  EXPECT_EQ(station_.state(), StationState::kStopped);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(station_.slew(slew(20.0), now_), Refusal::kPrecedence);
  EXPECT_EQ(station_.release(now_), Refusal::kJustStopped);
  now_ += Station::kStopHold_s;
  EXPECT_EQ(station_.release(now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_EQ(station_.slew(slew(20.0), now_), Refusal::kNone);
}

TEST_F(StationTest, AManualGoalStaysFreshUntilItsTimeIsOver) {
  run_until(100.5);
  ASSERT_EQ(station_.point({{0.2, 0.1}}, now_), Refusal::kNone);
  run_until(now_ + 3.0);
  const auto goal = station_.goal(now_);
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->time_s, now_);
  EXPECT_LT(goal->valid_until_s, now_ + config().point_time_s);
}

TEST_F(StationTest, StopEndsTracking) {
  designated_for(0.5);
  station_.stop(now_);
  const std::size_t before = bearings_.size();
  run_until(now_ + 1.0);
  EXPECT_EQ(station_.state(), StationState::kStopped);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_LE(bearings_.size(), before + 1);  // at most the one that waited for its angles
}

TEST_F(StationTest, RefusesToPointWhereTheUnitCannotReach) {
  run_until(100.5);
  EXPECT_EQ(station_.point({{0.0, 1.0}}, now_), Refusal::kUnreachable);
  EXPECT_EQ(station_.point({{std::nan(""), 0.0}}, now_), Refusal::kNotFinite);
  EXPECT_EQ(station_.state(), StationState::kIdle);
}

TEST_F(StationTest, FramesThatGoBackInTimeAreCountedAndLeftOut) {
  designated_for(0.2);
  const int before = script_.tracked;
  camera::Frame old;
  old.mid_exposure_s = now_ - 0.5;
  station_.on_frame(old);
  EXPECT_EQ(script_.tracked, before);
  EXPECT_EQ(station_.snapshot().counters.at("frames_out_of_order"), 1.0);
}

TEST_F(StationTest, PredictsTheHomographyFromThePtu) {
  designated_for(0.3);
  angles_.pan_rad += 0.01;  // to the left: the scene moves right
  run_until(now_ + 0.15);
  ASSERT_TRUE(script_.last && script_.last->predicted_homography);
  run_until(now_ + 0.3);
  const Eigen::Matrix3d still =
      *script_.last->predicted_homography / (*script_.last->predicted_homography)(2, 2);
  EXPECT_NEAR((still - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-6);
}

TEST_F(StationTest, CountsTheSecondsInEachState) {
  run_until(100.5);
  designated_for(2.0);
  EXPECT_NEAR(station_.snapshot().counters.at("seconds_tracking"), 2.0, 0.02);
}

// The fusion slews a station that it has no bearing of by what its status tells.
TEST_F(StationTest, TellsTheSamePlaceOfItsCameraAsItsBearings) {
  const Eigen::Vector3d at_zero = camera_centre_ecef(config().geometry, PanTilt{});
  EXPECT_EQ(station_.snapshot().camera_ecef, at_zero) << "before the unit has told its angles";
  angles_ = {0.8, 0.3};
  designated_for(0.5);
  const Eigen::Vector3d camera = bearings_.back().sight.origin_ecef;
  EXPECT_LT((station_.snapshot().camera_ecef - camera).norm(), 1e-9);
  EXPECT_GT((camera - at_zero).norm(), 0.01);
}

TEST_F(StationTest, WaitsForTheAnglesAfterTheExposureButNotForever) {
  designated_for(0.3);
  next_sample_ = now_ + 10.0;  // the PTU falls silent
  const std::size_t before = bearings_.size();
  run_until(now_ + 0.12);
  EXPECT_GT(bearings_.size(), before) << "extrapolated for a moment";
  run_until(now_ + 1.0);
  EXPECT_GT(station_.snapshot().counters.at("frames_without_angles"), 5.0);
}

tracker::ImageMotion image_motion(const StationGeometry& geometry, double pan_rad) {
  return {rotation_homography(geometry, {}, {pan_rad, 0.0}), {639.5, 479.5}, 0.05};
}

TEST_F(StationTest, ThePicturesOfTheTrackerCarryTheAnglesWhileTheMountIsSilent) {
  constexpr double kTurn_deg = 0.1;  // from frame to frame
  const StationGeometry geometry = config().geometry;
  script_.image_motion = image_motion(geometry, 0.0);
  designated_for(1.0);
  next_sample_ = 1e9;
  run_until(now_ + 0.2);
  script_.image_motion = image_motion(geometry, radians(kTurn_deg));
  bearings_.clear();
  run_until(now_ + 1.0);
  ASSERT_GT(bearings_.size(), 13U);
  double before_deg = degrees(bearings_.front().sight.direction.azimuth_rad);
  for (std::size_t i = 1; i < bearings_.size(); ++i) {
    const double azimuth_deg = degrees(bearings_[i].sight.direction.azimuth_rad);
    EXPECT_NEAR(azimuth_deg - before_deg, -kTurn_deg, 0.002);
    before_deg = azimuth_deg;
  }
  EXPECT_GT(bearings_.back().sight.covariance_white(0, 0),
            bearings_.front().sight.covariance_white(0, 0));
  script_.image_motion.reset();
  run_until(now_ + 0.2);
  bearings_.clear();
  run_until(now_ + 0.5);
  EXPECT_TRUE(bearings_.empty());
}

TEST_F(StationTest, ThePicturesOfTheDetectorCarryTheAnglesToo) {
  const StationGeometry geometry = config().geometry;
  double looked_s = 0.0;
  const auto look = [&](double pan_rad) {
    std::optional<detector::Picture> picture;
    while (!picture) {
      run_until(now_ + 0.01);
      picture = station_.picture_to_search(now_);
    }
    detector::Found found;
    found.mid_exposure_s = picture->mid_exposure_s;
    found.motion = image_motion(geometry, pan_rad);
    found.from_s = std::exchange(looked_s, picture->mid_exposure_s);
    station_.on_found(std::move(found));
  };
  for (int i = 0; i < 5; ++i) look(0.0);
  next_sample_ = 1e9;
  look(0.0);
  for (int i = 0; i < 3; ++i) look(radians(0.3));
  script_.image_motion = image_motion(geometry, 0.0);
  ASSERT_EQ(station_.designate({looked_s, {629, 469, 20, 20}}, now_), Refusal::kNone);
  run_until(now_ + 0.3);
  ASSERT_FALSE(bearings_.empty());
  EXPECT_NEAR(degrees(bearings_.back().sight.direction.azimuth_rad), 30.0 - 0.9, 0.005);
}

TEST_F(StationTest, CountsFramesThatMoveOtherwiseThanTheAnglesSay) {
  const auto counter = [this](const char* name) { return station_.snapshot().counters[name]; };
  designated();
  script_.prediction_error_px = config().prediction_error_px - 1.0;
  run_until(now_ + 1.0);
  EXPECT_EQ(counter("predictions_disagreeing"), 0.0);
  script_.prediction_error_px = config().prediction_error_px + 1.0;
  const int tracked = script_.tracked;
  run_until(now_ + 3.5 * test::kFrame_s);
  EXPECT_EQ(counter("predictions_disagreeing"), script_.tracked - tracked);
  EXPECT_FALSE(station_.snapshot().motion_disagrees);
  run_until(now_ + 0.5);
  EXPECT_TRUE(station_.snapshot().motion_disagrees);
  script_.prediction_error_px = std::nullopt;  // a blank sky says nothing
  run_until(now_ + 0.5);
  EXPECT_TRUE(station_.snapshot().motion_disagrees);
  script_.prediction_error_px = 0.5;
  run_until(now_ + 0.5);
  EXPECT_FALSE(station_.snapshot().motion_disagrees);
}

TEST_F(StationTest, CountsPredictionsThatTheTrackerDropped) {
  designated();
  script_.prediction_dropped = true;
  const int tracked = script_.tracked;
  run_until(now_ + 0.5);
  EXPECT_GT(script_.tracked, tracked);
  EXPECT_EQ(station_.snapshot().counters["predictions_dropped"], script_.tracked - tracked);
}

}  // namespace
}  // namespace ols::station
