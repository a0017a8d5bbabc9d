// A joystick in simulated time: the product's station and PTU driver on the simulated unit, rates
// ten times a second as the console sends them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "edge/ptu/driver.h"
#include "geometry/slew_limits.h"
#include "sim/ptu/unit.h"
#include "station_fixture.h"

namespace ols::station {
namespace {

constexpr double kTick_s = 1e-3, kAgain_s = 0.1;
constexpr double kStanding_rad = 1e-5;  // less than a count

class JoystickTest : public testing::Test {
 protected:
  JoystickTest() { begin({}); }

  // A ready unit at zero, with these regions.
  void begin(const std::vector<mount::KeepOut>& keep_out) {
    sim::PtuUnitConfig unit;
    unit.baud = 38400;
    unit.home_at_power_up = false;
    unit_ = std::make_unique<sim::PtuUnit>(unit, 7, now_s_);
    ptu::PtuConfig driver;
    driver.baud = 38400;
    driver.poll_interval_s = 0.025;
    driver.limits.keep_out = keep_out;
    acceleration_ = driver.servo.max_acceleration_rad_s2;
    driver_ = std::make_unique<ptu::PtuDriver>(driver);
    StationConfig config;
    config.geometry.position = {radians(49.2), radians(16.6), 250.0};
    station_ = std::make_unique<Station>(config, std::make_unique<test::ScriptedTracker>(script_));
    const double until_s = now_s_ + 5.0;
    while (driver_->state() != ptu::PtuState::kReady && now_s_ < until_s) tick();
    ASSERT_EQ(driver_->state(), ptu::PtuState::kReady);
    station_->set_limits(driver_->limits());
  }

  void tick() {
    now_s_ += kTick_s;
    driver_->receive(unit_->transmit(now_s_), now_s_);
    const std::string request = driver_->step(now_s_);
    if (!request.empty()) unit_->receive(request, now_s_);
    for (const auto& sample : driver_->take_samples()) station_->on_angles(sample);
    station_->set_reference(driver_->reference());
    driver_->set_goal(station_->step(now_s_).goal);
  }

  RateCommand command(double pan_rad_s, double tilt_rad_s = 0.0) {
    return {{pan_rad_s, tilt_rad_s}, now_s_, kRateLease_s, 5, ++sequence_};
  }

  // The hand holds for so long; returns when the last rate came.
  double hold(double seconds, double pan_rad_s, double tilt_rad_s = 0.0) {
    const double end_s = now_s_ + seconds;
    double last_s = -1.0;
    while (now_s_ < end_s) {
      if (now_s_ - last_s >= kAgain_s) {
        last_s = now_s_;
        EXPECT_EQ(station_->rate(command(pan_rad_s, tilt_rad_s), now_s_), Refusal::kNone);
      }
      tick();
    }
    return last_s;
  }

  PanTilt truth() const { return unit_->angles_at(now_s_); }

  // Nothing comes any more: when the unit stands.
  double rests_s(double patience_s = 5.0) {
    const double end_s = now_s_ + patience_s;
    PanTilt before = truth();
    double moved_s = now_s_;
    while (now_s_ < end_s) {
      for (int i = 0; i < 10; ++i) tick();
      const PanTilt at = truth();
      const double way = std::hypot(at.pan_rad - before.pan_rad, at.tilt_rad - before.tilt_rad);
      if (way > kStanding_rad) moved_s = now_s_;
      before = at;
    }
    return moved_s;
  }

  test::ScriptedTracker::Script script_;
  std::unique_ptr<sim::PtuUnit> unit_;
  std::unique_ptr<ptu::PtuDriver> driver_;
  std::unique_ptr<Station> station_;
  double now_s_ = 100.0;
  double acceleration_ = 0.0;
  std::int64_t sequence_ = 0;
};

TEST_F(JoystickTest, TheUnitTurnsAtTheRateWhileTheHandHolds) {
  hold(2.0, 0.3, -0.1);
  const PanTilt from = truth();
  hold(1.0, 0.3, -0.1);
  EXPECT_NEAR(truth().pan_rad - from.pan_rad, 0.3, 0.01);
  EXPECT_NEAR(truth().tilt_rad - from.tilt_rad, -0.1, 0.005);
  EXPECT_EQ(station_->state(), StationState::kManual);
}

// The measure: the link is cut during a hold, and the unit is at rest within lease + v/a.
TEST_F(JoystickTest, ACutLinkLeavesItAtRestWithinLeaseAndBraking) {
  for (const double rate : {0.05, 0.2, 0.4, 0.6}) {
    const double last_s = hold(1.5, rate);
    EXPECT_LE(rests_s() - last_s, kRateLease_s + rate / acceleration_) << rate << " rad/s";
    hold(1.5, -rate);
    rests_s();
  }
}

TEST_F(JoystickTest, LettingGoStopsItWithinItsBrakingTime) {
  constexpr double kTurnAndPoll_s = 0.06;
  hold(1.5, 0.4);
  EXPECT_EQ(station_->rate(command(0.0), now_s_), Refusal::kNone);
  const double let_go_s = now_s_;
  EXPECT_LE(rests_s() - let_go_s, kTurnAndPoll_s + 0.4 / acceleration_);
}

// One axis stops while the other goes on: it does not swing back to where it was let go.
TEST_F(JoystickTest, AnAxisThatIsLetGoDoesNotComeBack) {
  hold(1.5, 0.4, 0.1);
  hold(0.1, 0.0, 0.1);
  double furthest = truth().pan_rad;
  for (int i = 0; i < 10; ++i) {
    hold(0.1, 0.0, 0.1);
    furthest = std::max(furthest, truth().pan_rad);
  }
  EXPECT_NEAR(truth().pan_rad, furthest, radians(0.02));
}

TEST_F(JoystickTest, ARateEndsAtTheTravelsLimitWithoutHittingIt) {
  hold(3.0, 0.0, 0.6);
  const double limit_rad = driver_->limits().tilt_max_rad;
  EXPECT_NEAR(truth().tilt_rad, limit_rad, radians(0.01));
  EXPECT_EQ(driver_->counters().limit_hits, 0U);
  hold(0.5, 0.0, -0.4);
  EXPECT_LT(truth().tilt_rad, limit_rad - radians(1.0)) << "and leads away from it again";
}

TEST_F(JoystickTest, ARateNeverEntersAKeepOutRegion) {
  const mount::KeepOut mast{0.5, 0.8, -0.3, 0.3};
  begin({mast});
  double furthest = 0.0;
  for (int i = 0; i < 40; ++i) {
    hold(0.1, 0.6);
    furthest = std::max(furthest, truth().pan_rad);
  }
  EXPECT_LT(furthest, mast.pan_min_rad);
  EXPECT_GT(furthest, mast.pan_min_rad - radians(3.0)) << "up to its border";
  hold(1.0, -0.4);
  EXPECT_LT(truth().pan_rad, furthest - radians(5.0)) << "and away from it";
}

TEST_F(JoystickTest, AHandThatStillHoldsDoesNotEndAStop) {
  hold(1.0, 0.4);
  station_->stop(now_s_);
  EXPECT_EQ(station_->rate(command(0.4), now_s_), Refusal::kJustStopped);
  rests_s(2.0);
  const PanTilt stood = truth();
  EXPECT_EQ(station_->rate(command(0.4), now_s_), Refusal::kStopped);
  rests_s(1.0);
  EXPECT_EQ(truth().pan_rad, stood.pan_rad);
  EXPECT_EQ(station_->release(now_s_), Refusal::kNone);
  EXPECT_EQ(station_->rate(command(0.4), now_s_), Refusal::kNone);
}

TEST_F(JoystickTest, NoSpoiltRateMovesAnything) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [&](auto&& spoil) {
    RateCommand spoilt = command(0.2);
    spoil(spoilt);
    return station_->rate(spoilt, now_s_);
  };
  EXPECT_EQ(refusal([&](auto& c) { c.rate.pan_rad = nan; }), Refusal::kNotFinite);
  EXPECT_EQ(refusal([&](auto& c) { c.rate.tilt_rad = -1.0 / 0.0; }), Refusal::kNotFinite);
  EXPECT_EQ(refusal([&](auto& c) { c.lease_s = nan; }), Refusal::kNotFinite);
  EXPECT_EQ(refusal([&](auto& c) { c.rate.pan_rad = 1.6; }), Refusal::kOutOfRange);
  EXPECT_EQ(refusal([&](auto& c) { c.lease_s = 0.31; }), Refusal::kOutOfRange);
  EXPECT_EQ(refusal([&](auto& c) { c.lease_s = 0.0; }), Refusal::kOutOfRange);
  rests_s(1.0);
  EXPECT_EQ(truth().pan_rad, 0.0);
  EXPECT_EQ(station_->state(), StationState::kIdle);
  EXPECT_EQ(station_->snapshot().counters.at("rate_refused"), 6.0);
}

TEST_F(JoystickTest, ARateThatWasOvertakenOnItsWayIsRefused) {
  const RateCommand early = command(0.4);
  hold(0.1, 0.0);
  EXPECT_EQ(station_->rate(early, now_s_), Refusal::kOvertaken);
  rests_s(1.0);
  EXPECT_EQ(truth().pan_rad, 0.0);
  EXPECT_EQ(station_->snapshot().counters.at("refused_overtaken"), 1.0);
}

}  // namespace
}  // namespace ols::station
