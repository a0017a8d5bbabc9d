// A target that the land hides, as the fusion predicts it.
#include <gtest/gtest.h>

#include <limits>

#include "station_fixture.h"

namespace ols::station {
namespace {

class StationOcclusionTest : public test::StationTest {
 protected:
  // Two degrees to the right of the optical axis, three seconds from now.
  OcclusionCommand hidden(double holds_s = 4.0) const {
    OcclusionCommand command;
    command.made_s = command.received_s = now_;
    command.holds_s = holds_s;
    command.exit = {now_ + 3.0, 0.2, {radians(32.0), 0.0}, 1e-3};
    return command;
  }
  void vanish() {
    script_.belief = 0.05;
    run_until(now_ + config().coast_s + 0.2);
  }
};

TEST_F(StationOcclusionTest, AHiddenTargetIsAwaitedWhereItComesOut) {
  designated_for(0.5);
  const double until_s = now_ + 3.0;
  ASSERT_EQ(station_.occlude(hidden(), now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kTracking) << "while it is still seen";
  vanish();
  ASSERT_EQ(station_.state(), StationState::kHidden);
  const StationSnapshot snapshot = station_.snapshot();
  EXPECT_EQ(snapshot.belief, 0.9);
  EXPECT_NEAR(snapshot.hidden_since_s.value_or(0.0), now_ - 0.2, 0.1);
  EXPECT_NEAR(snapshot.hidden_until_s.value_or(0.0), until_s, 1e-9);
  const auto goal = station_.goal(now_);
  ASSERT_TRUE(goal && goal->rests);
  EXPECT_NEAR(degrees(goal->angles.pan_rad), -2.0, 1e-3);
  angles_ = goal->angles;
  run_until(now_ + 0.6);
  EXPECT_NEAR(script_.searched_pixel.x(), 639.5, 2.0);
  script_.belief = 0.9;
  script_.pixel = {439.5, 479.5};
  run_until(now_ + 0.4);
  EXPECT_EQ(station_.state(), StationState::kHidden) << "something else is elsewhere";
  script_.pixel = {639.5, 479.5};
  run_until(now_ + 0.3);
  EXPECT_EQ(station_.state(), StationState::kTracking);
  EXPECT_EQ(station_.snapshot().counters.count("entered_lost"), 0U);
}

TEST_F(StationOcclusionTest, APredictionThatNoLongerHoldsIsIgnored) {
  for (const bool withdrawn : {false, true}) {
    designated_for(0.5);
    ASSERT_EQ(station_.occlude(hidden(2.0), now_), Refusal::kNone);
    OcclusionCommand older = hidden(0.0);
    older.made_s -= 0.1;
    ASSERT_EQ(station_.occlude(older, now_), Refusal::kOvertaken);
    vanish();
    ASSERT_EQ(station_.state(), StationState::kHidden);
    if (withdrawn) ASSERT_EQ(station_.occlude(hidden(0.0), now_), Refusal::kNone);
    run_until(now_ + (withdrawn ? 0.1 : 1.2));
    EXPECT_EQ(station_.state(), StationState::kLost);
    EXPECT_FALSE(station_.goal(now_));
    script_.belief = 0.9;
  }
}

TEST_F(StationOcclusionTest, OneThatDoesNotComeOutIsFollowedBySlews) {
  designated_for(0.5);
  OcclusionCommand command = hidden();
  command.exit.reset();
  ASSERT_EQ(station_.occlude(command, now_), Refusal::kNone);
  vanish();
  EXPECT_EQ(station_.state(), StationState::kHidden);
  EXPECT_FALSE(station_.goal(now_));
  ASSERT_EQ(station_.slew(slew(34.0), now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kHidden);
  EXPECT_NEAR(degrees(station_.goal(now_)->angles.pan_rad), -4.0, 1e-3);
}

TEST_F(StationOcclusionTest, AnOperatorAndAStopEndIt) {
  designated_for(0.5);
  ASSERT_EQ(station_.occlude(hidden(), now_), Refusal::kNone);
  vanish();
  station_.stop(now_);
  EXPECT_EQ(station_.state(), StationState::kStopped);
  EXPECT_EQ(station_.occlude(hidden(), now_), Refusal::kPrecedence);
  run_until(now_ + 1.1);
  ASSERT_EQ(station_.release(now_), Refusal::kNone);
  run_until(now_ + 0.1);
  EXPECT_EQ(station_.state(), StationState::kLost);
}

TEST_F(StationOcclusionTest, AbsurdOnesAreRefused) {
  designated_for(0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](auto change) {
    OcclusionCommand command = hidden();
    change(command);
    return station_.occlude(command, now_);
  };
  EXPECT_EQ(refused([&](auto& c) { c.holds_s = nan; }), Refusal::kNotFinite);
  EXPECT_EQ(refused([&](auto& c) { c.exit->sd_s = nan; }), Refusal::kNotFinite);
  EXPECT_EQ(refused([](auto& c) { c.holds_s = 16.0; }), Refusal::kOutOfRange);
  EXPECT_EQ(refused([](auto& c) { c.holds_s = -1.0; }), Refusal::kOutOfRange);
  EXPECT_EQ(refused([](auto& c) { c.exit->time_s += 20.0; }), Refusal::kOutOfRange);
  EXPECT_EQ(refused([](auto& c) { c.exit->direction.elevation_rad = 2.0; }), Refusal::kOutOfRange);
  EXPECT_EQ(refused([](auto& c) { c.exit->direction.elevation_rad = 1.5; }), Refusal::kUnreachable);
  EXPECT_EQ(station_.snapshot().counters.at("occlusion_refused"), 7.0);
}

}  // namespace
}  // namespace ols::station
