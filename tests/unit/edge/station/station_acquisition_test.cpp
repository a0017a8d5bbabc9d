// How a slewed station comes to its target.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "edge/station/station.h"
#include "geometry/angles.h"
#include "station_fixture.h"

namespace ols::station {
namespace {

using test::StationTest;

// The target is a spot in the sky where the slew says.
class AcquisitionBySlewTest : public StationTest {
 protected:
  // Frames show the spot at this pixel, slews lead to the optical axis.
  void run_slewed(double seconds, const std::optional<cv::Point>& spot) {
    sky_ = cv::Mat(960, 1280, CV_8U, cv::Scalar(180));
    if (spot) cv::circle(sky_, *spot, 12, cv::Scalar(60), cv::FILLED);
    for (const double end_s = now_ + seconds; now_ < end_s;) {
      SlewCommand command = slew(30.0);
      command.sender = senders_[static_cast<std::size_t>(++slews_) % senders_.size()];
      station_.slew(command, now_);
      run_until(now_ + 0.1, true, sky_);
    }
  }
  double counter(const char* name) const {
    const auto counters = station_.snapshot().counters;
    return counters.contains(name) ? counters.at(name) : 0.0;
  }
  bool alarmed(const char* words) const {
    const auto alarms = station_.snapshot().alarms;
    return std::ranges::any_of(
        alarms, [&](const std::string& alarm) { return alarm.find(words) != std::string::npos; });
  }
  // A box on empty sky: the tracker loses it and does not find it again.
  void designated_in_vain() {
    designated();
    script_.belief = 0.1;
    run_until(now_ + 1.0);
    ASSERT_EQ(station_.state(), StationState::kLost);
  }
  cv::Mat sky_;
  std::vector<std::int64_t> senders_{1};
  int slews_ = 0;
};

TEST_F(AcquisitionBySlewTest, FindsTheTargetTracksItAndIsHonestAboutTheBox) {
  run_slewed(1.5, cv::Point(660, 470));
  EXPECT_EQ(script_.initialised, 1);
  EXPECT_EQ(script_.searches, 0) << "the first frames are judged by the template that was found";
  EXPECT_NEAR(script_.first_box.x + 0.5 * script_.first_box.width, 660.5, 1.0);
  EXPECT_NEAR(script_.first_box.y + 0.5 * script_.first_box.height, 470.5, 1.0);
  EXPECT_EQ(station_.state(), StationState::kTracking);
  EXPECT_EQ(counter("acquisitions"), 1.0);
  EXPECT_GE(counter("acquisition_candidates"), 3.0);
  ASSERT_FALSE(bearings_.empty());
  EXPECT_EQ(bearings_.back().track_id, 1);
  EXPECT_TRUE(bearings_.back().acquired);
  const double grown = script_.size_px / std::sqrt(script_.first_box.area());
  EXPECT_NEAR(std::sqrt(bearings_.back().sight.covariance_systematic(0, 0)),
              std::hypot(radians(0.02), grown * config().acquisition_sd_px * 75e-6), 2e-6);
}

TEST_F(AcquisitionBySlewTest, FindsNothingWhereNothingIs) {
  run_slewed(5.0, std::nullopt);
  EXPECT_EQ(script_.initialised, 0);
  EXPECT_EQ(station_.state(), StationState::kSlewed);
  run_until(now_ + 0.6);
  EXPECT_EQ(station_.state(), StationState::kIdle);
}

TEST_F(AcquisitionBySlewTest, ForgetsWhatTheTrackerDoesNotBelieveIn) {
  script_.belief = 0.1;
  run_slewed(1.5, cv::Point(660, 470));
  EXPECT_EQ(counter("acquisitions_dropped"), 1.0);
  EXPECT_TRUE(bearings_.empty());
  EXPECT_EQ(station_.state(), StationState::kSlewed);
}

TEST_F(AcquisitionBySlewTest, ADesignationTakesPrecedence) {
  designated();
  script_.belief = 0.1;
  run_slewed(3.0, cv::Point(660, 470));
  EXPECT_EQ(station_.state(), StationState::kSlewed);
  EXPECT_EQ(script_.initialised, 1);
  EXPECT_EQ(counter("acquisitions"), 0.0);
  EXPECT_GE(script_.searches, 2);
}

// One wrong designation must not lose a station for good.
TEST_F(AcquisitionBySlewTest, AcquiresWhatItIsSlewedOntoWhenItsOwnTargetIsNotThere) {
  designated_in_vain();
  run_slewed(config().own_target_s - 0.5, cv::Point(660, 470));
  EXPECT_EQ(script_.initialised, 1) << "its own target comes first";
  EXPECT_EQ(counter("acquisitions"), 0.0);
  run_slewed(0.8, cv::Point(660, 470));
  EXPECT_EQ(script_.initialised, 2);
  EXPECT_EQ(script_.set_aside, 1);
  script_.belief = 0.9;
  script_.pixel = {659.5, 469.5};
  bearings_.clear();
  run_slewed(0.6, cv::Point(660, 470));
  EXPECT_EQ(station_.state(), StationState::kTracking);
  ASSERT_FALSE(bearings_.empty());
  EXPECT_EQ(bearings_.back().track_id, 2);
  EXPECT_EQ(script_.taken_back, 0);
}

TEST_F(AcquisitionBySlewTest, GoesBackToItsOwnTargetWhenWhatItFoundIsNotBelievedIn) {
  designated_in_vain();
  run_slewed(config().own_target_s + 1.5, cv::Point(660, 470));
  EXPECT_EQ(counter("acquisitions_dropped"), 1.0);
  EXPECT_EQ(script_.set_aside, 1);
  EXPECT_EQ(script_.taken_back, 1);
  run_slewed(config().own_target_s - 1.0, cv::Point(660, 470));
  EXPECT_EQ(script_.set_aside, 1) << "its own has its time again";
  script_.belief = 0.9;
  script_.pixel = {639.5, 479.5};
  bearings_.clear();
  run_slewed(0.5, std::nullopt);
  EXPECT_EQ(station_.state(), StationState::kTracking);
  ASSERT_FALSE(bearings_.empty());
  EXPECT_EQ(bearings_.back().track_id, 1) << "the same object as before";
  ASSERT_EQ(station_.designate({std::nullopt, {629, 469, 20, 20}}, now_), Refusal::kNone);
  run_until(now_ + 0.3);
  EXPECT_EQ(bearings_.back().track_id, 3) << "an id means one thing";
  EXPECT_FALSE(bearings_.back().acquired) << "an operator designated it";
}

TEST_F(AcquisitionBySlewTest, PrefersItsOwnTargetWhileItIsThere) {
  designated_in_vain();
  run_slewed(2.0, std::nullopt);
  script_.belief = 0.9;
  run_slewed(8.0, cv::Point(660, 470));
  EXPECT_EQ(station_.state(), StationState::kTracking);
  EXPECT_EQ(script_.initialised, 1);
}

TEST_F(AcquisitionBySlewTest, SaysThatItAcquiresNothingWhereTheSlewsLead) {
  designated_in_vain();
  run_slewed(config().unacquired_alarm_s - 0.5, std::nullopt);
  EXPECT_TRUE(station_.snapshot().alarms.empty());
  run_slewed(2.0, std::nullopt);
  EXPECT_TRUE(alarmed("target: not found for 1") &&
              alarmed(" s, although its place is in the image"));
  script_.belief = 0.9;
  run_slewed(0.5, std::nullopt);
  EXPECT_EQ(station_.state(), StationState::kTracking);
  EXPECT_TRUE(station_.snapshot().alarms.empty());
}

TEST_F(AcquisitionBySlewTest, SaysSoWithoutEverHavingHadATarget) {
  run_slewed(12.0, std::nullopt);
  EXPECT_TRUE(alarmed("target: not found for"));
  run_until(now_ + 1.0);
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_TRUE(station_.snapshot().alarms.empty()) << "it is not slewed";
}

// On its way, or where the unit does not get, there is nothing to be acquired.
TEST_F(AcquisitionBySlewTest, SaysNothingWhileTheSlewsPlaceIsNotInThePicture) {
  angles_.pan_rad = radians(20.0);
  run_slewed(15.0, std::nullopt);
  EXPECT_EQ(station_.state(), StationState::kSlewed);
  EXPECT_TRUE(station_.snapshot().alarms.empty());
}

TEST_F(AcquisitionBySlewTest, SaysThatTwoFusionsSlewIt) {
  run_slewed(3.0, std::nullopt);
  senders_ = {2};  // restarted
  run_slewed(1.0, std::nullopt);
  EXPECT_FALSE(alarmed("two fusions")) << "one after the other";
  senders_ = {2, 3};
  run_slewed(1.0, std::nullopt);
  EXPECT_TRUE(alarmed("commands: slews from two fusions"));
  senders_ = {3};
  run_slewed(6.0, std::nullopt);
  EXPECT_FALSE(alarmed("two fusions"));
}

}  // namespace
}  // namespace ols::station
