#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "edge/station/station.h"
#include "geometry/angles.h"
#include "station_fixture.h"

namespace ols::station {
namespace {

class StationSlewTest : public test::StationTest {};

TEST_F(StationSlewTest, ASlewMovesAnIdleStationForItsLease) {
  run_until(100.5);
  ASSERT_EQ(station_.slew(slew(20.0), now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kSlewed);
  const auto goal = station_.goal(now_);
  ASSERT_TRUE(goal);
  EXPECT_NEAR(degrees(goal->angles.pan_rad), 10.0, 1e-3);
  EXPECT_NEAR(goal->valid_until_s, now_ + 0.5, 1e-9);
  run_until(now_ + 0.6);
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_FALSE(station_.goal(now_));
}

TEST_F(StationSlewTest, ASlewCarriesItsRate) {
  run_until(100.5);
  auto command = slew(20.0);
  command.azimuth_rate_rad_s = 0.1;
  ASSERT_EQ(station_.slew(command, now_), Refusal::kNone);
  EXPECT_NEAR(station_.goal(now_)->rate.pan_rad, -0.1, 1e-4);
}

TEST_F(StationSlewTest, ALostStationIsSlewedBackOntoTheTarget) {
  designated_for(0.5);
  script_.belief = 0.1;
  run_until(now_ + config().coast_s + 0.2);
  ASSERT_EQ(station_.state(), StationState::kLost);
  ASSERT_EQ(station_.slew(slew(30.5, 0.4), now_), Refusal::kNone);
  run_until(now_ + 0.2);
  EXPECT_EQ(station_.state(), StationState::kSlewed);
  ASSERT_GE(script_.searches, 1);
  // The slew points half a degree to the right of the axis and 0.4 above it.
  EXPECT_NEAR(script_.searched_pixel.x(), 639.5 + std::tan(radians(0.5)) / 75e-6, 2.0);
  EXPECT_NEAR(script_.searched_pixel.y(), 479.5 - std::tan(radians(0.4)) / 75e-6, 2.0);
  script_.belief = 0.9;
  script_.pixel = script_.searched_pixel;
  run_until(now_ + 0.1);
  EXPECT_EQ(station_.state(), StationState::kSlewed) << "one believed frame is not enough";
  run_until(now_ + 0.2);
  EXPECT_EQ(station_.state(), StationState::kTracking);
}

TEST_F(StationSlewTest, ASlewedStationBelievesOnlyWhatIsWhereTheSlewSays) {
  designated();
  script_.belief = 0.1;
  run_until(now_ + 1.5);
  ASSERT_EQ(station_.state(), StationState::kLost);
  bearings_.clear();
  script_.belief = 0.99;
  script_.pixel = {439.5, 479.5};  // 200 px beside
  for (int i = 0; i < 8; ++i) {
    ASSERT_EQ(station_.slew(slew(30.0), now_), Refusal::kNone);
    run_until(now_ + 0.25);
    EXPECT_EQ(station_.state(), StationState::kSlewed);
  }
  EXPECT_TRUE(bearings_.empty());
  EXPECT_GE(script_.searches, 3);  // again and again
  EXPECT_GT(station_.snapshot().counters.at("frames_elsewhere"), 10.0);
  script_.pixel = {619.5, 489.5};
  ASSERT_EQ(station_.slew(slew(30.0), now_), Refusal::kNone);
  run_until(now_ + 0.45);
  EXPECT_EQ(station_.state(), StationState::kTracking);
}

TEST_F(StationSlewTest, ItLetsGoOfWhatAnOperatorHasDismissedAndOfNothingElse) {
  designated_for(0.5);
  SlewCommand command = slew(30.0);
  command.let_go_track_id = station_.snapshot().track_id + 1;
  ASSERT_EQ(station_.slew(command, now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kTracking) << "it follows another";
  --command.let_go_track_id;
  command.received_s = now_;
  ASSERT_EQ(station_.slew(command, now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kSlewed);
  run_until(now_ + command.lease_s + 0.2);
  EXPECT_EQ(station_.state(), StationState::kIdle) << "there is nothing to look for";
  designated_for(0.5);
  command = {.effect_s = now_, .received_s = now_, .lease_s = 0.5, .direction = command.direction};
  command.let_go_track_id = station_.snapshot().track_id;
  ASSERT_EQ(station_.slew(command, now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kIdle) << "it only lets go";
}

TEST_F(StationSlewTest, ASlewedStationAllowsForWhatItDoesNotKnowOfItsOwnHeading) {
  StationConfig rough = config();
  rough.geometry.sd.heading_rad = radians(0.5);
  Station station(rough, std::make_unique<test::ScriptedTracker>(script_));
  station.set_reference(mount::Reference::kTrusted);
  camera::Frame frame;
  const auto show = [&](double until_s) {
    for (; now_ < until_s; now_ += test::kFrame_s) {
      station.on_angles(sample());
      frame.mid_exposure_s = now_ - 0.02;
      station.on_frame(frame, now_);
      station.step(now_);
    }
  };
  show(now_ + 0.3);
  ASSERT_EQ(station.designate({std::nullopt, {629, 469, 20, 20}}, now_), Refusal::kNone);
  script_.belief = 0.1;
  show(now_ + 1.5);
  ASSERT_EQ(station.state(), StationState::kLost);
  script_.belief = 0.99;
  script_.pixel = {439.5, 479.5};  // 0.86 deg beside where the slew says
  ASSERT_EQ(station.slew(slew(30.0), now_), Refusal::kNone);
  show(now_ + 0.45);
  EXPECT_EQ(station.state(), StationState::kTracking);
}

}  // namespace
}  // namespace ols::station
