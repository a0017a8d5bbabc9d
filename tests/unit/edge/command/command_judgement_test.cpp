#include "edge/command/command_judgement.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/angles.h"
#include "geometry/slew_limits.h"

namespace ols::station {
namespace {

constexpr double kNow_s = 100.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

StationConfig level_station() {
  StationConfig config;
  config.geometry.position = {radians(49.2), radians(16.6), 250.0};
  config.limits = {-radians(159), radians(159), -radians(46), radians(31)};
  return config;
}

// The optical axis is on azimuth 0 at pan 0; a lower pan is a greater azimuth.
class CommandJudgementTest : public testing::Test {
 protected:
  CommandJudgementTest() { mode_.set_reference(mount::Reference::kTrusted); }
  Situation now() const { return {config_, mode_, pointing_, kNow_s}; }
  template <class Command>
  Refusal judged(const Command& command) const {
    return judge(command, now());
  }
  static SlewCommand slew(double azimuth_deg) {
    SlewCommand command;
    command.effect_s = command.received_s = kNow_s;
    command.lease_s = 0.5;
    command.direction = {radians(azimuth_deg), 0.0};
    command.direction_sd_rad = 1e-3;
    return command;
  }

  StationConfig config_ = level_station();
  StationMode mode_;
  PointingModel pointing_{config_};
};

TEST_F(CommandJudgementTest, AnOrdinaryCommandIsPermitted) {
  EXPECT_EQ(judged(DesignateCommand{std::nullopt, {10, 10, 20, 20}}), Refusal::kNone);
  EXPECT_EQ(judged(slew(20.0)), Refusal::kNone);
  EXPECT_EQ(judged(PointCommand{{0.1, 0.1}}), Refusal::kNone);
  EXPECT_EQ(judge_home(now()), Refusal::kNone);
}

TEST_F(CommandJudgementTest, AFixedMountIsNeverMoved) {
  config_.moves = false;
  EXPECT_EQ(judged(slew(20.0)), Refusal::kFixedMount);
  EXPECT_EQ(judged(PointCommand{{0.1, 0.1}}), Refusal::kFixedMount);
  EXPECT_EQ(judged(RateCommand{{0.1, 0.0}, kNow_s, 0.2}), Refusal::kFixedMount);
  EXPECT_EQ(judge_motion(now()), Refusal::kFixedMount);
  EXPECT_EQ(judge_home(now()), Refusal::kFixedMount);
  EXPECT_EQ(judged(DesignateCommand{std::nullopt, {10, 10, 20, 20}}), Refusal::kNone);
}

TEST_F(CommandJudgementTest, NothingButRearmingIsPermittedInAnEmergency) {
  mode_.enter(StationState::kEmergency);
  EXPECT_EQ(judged(DesignateCommand{}), Refusal::kEmergency);
  EXPECT_EQ(judged(slew(20.0)), Refusal::kEmergency);
  EXPECT_EQ(judged(PointCommand{}), Refusal::kEmergency);
  EXPECT_EQ(judge_home(now()), Refusal::kEmergency);
  EXPECT_EQ(judge_reference_ok(now()), Refusal::kEmergency);
  EXPECT_EQ(judge_rearm(now()), Refusal::kNone);
  mode_.set_pressed(true);
  EXPECT_EQ(judge_rearm(now()), Refusal::kEmergency);
}

TEST_F(CommandJudgementTest, ASlewIsForAnInstantNearNow) {
  for (const double side : {-1.0, 1.0}) {
    SlewCommand command = slew(20.0);
    command.effect_s = kNow_s + side * kSlewLead_s;
    EXPECT_EQ(judged(command), Refusal::kNone);
    command.effect_s = kNow_s + side * (kSlewLead_s + 0.01);
    EXPECT_EQ(judged(command), Refusal::kOutOfRange);
  }
}

TEST_F(CommandJudgementTest, TheOperatorTakesPrecedenceOverASlew) {
  for (const StationState state : {StationState::kManual, StationState::kStopped}) {
    mode_.enter(state);
    EXPECT_EQ(judged(slew(20.0)), Refusal::kPrecedence);
    EXPECT_EQ(judged(PointCommand{{0.1, 0.1}}), Refusal::kNone);
  }
}

// Both ends of the lease lie in the travel here, and yet the unit would have to pass its stop.
TEST_F(CommandJudgementTest, ASlewStaysReachableForItsWholeLease) {
  SlewCommand command = slew(150.0);
  EXPECT_EQ(judged(command), Refusal::kNone);
  command.azimuth_rate_rad_s = radians(30.0);
  EXPECT_EQ(judged(command), Refusal::kUnreachable) << "at 165 degrees when the lease ends";
  command.azimuth_rate_rad_s = -radians(30.0);
  EXPECT_EQ(judged(command), Refusal::kNone);
  EXPECT_EQ(judged(slew(180.0)), Refusal::kUnreachable);
}

TEST_F(CommandJudgementTest, AnglesBeyondATurnAreASlipOfTheHand) {
  EXPECT_EQ(judged(PointCommand{{kPointPanLimit_rad, 0.0}}), Refusal::kNone);
  EXPECT_EQ(judged(PointCommand{{-1.01 * kPointPanLimit_rad, 0.0}}), Refusal::kOutOfRange);
  EXPECT_EQ(judged(PointCommand{{0.0, 1.01 * kPointTiltLimit_rad}}), Refusal::kOutOfRange);
}

TEST_F(CommandJudgementTest, MotionNeedsAUnitAndItsReference) {
  mode_.set_reference(mount::Reference::kUnknown);
  EXPECT_EQ(judged(PointCommand{}), Refusal::kNoUnit);
  EXPECT_EQ(judge_home(now()), Refusal::kNoUnit);
  EXPECT_EQ(judge_reference_ok(now()), Refusal::kNoDoubt);
  mode_.set_reference(mount::Reference::kMissing);
  EXPECT_EQ(judged(PointCommand{}), Refusal::kNoReference);
  EXPECT_EQ(judged(slew(20.0)), Refusal::kNoReference);
  EXPECT_EQ(judge_home(now()), Refusal::kNone) << "homing is what finds it";
  EXPECT_EQ(judge_reference_ok(now()), Refusal::kNoReference) << "no person knows it either";
  mode_.set_reference(mount::Reference::kDoubted);
  EXPECT_EQ(judged(PointCommand{}), Refusal::kNoReference);
  EXPECT_EQ(judge_reference_ok(now()), Refusal::kNone);
}

TEST_F(CommandJudgementTest, TheConfigurationForbidsHomingAndPermitsRearmingOverTheBus) {
  EXPECT_EQ(judge_rearm_over_bus(now()), Refusal::kRearmNeedsAHand);
  config_.homing_allowed = false;
  config_.rearm_over_bus = true;
  EXPECT_EQ(judge_home(now()), Refusal::kKeepOut);
  EXPECT_EQ(judge_rearm_over_bus(now()), Refusal::kNone);
  mode_.set_pressed(true);
  EXPECT_EQ(judge_rearm_over_bus(now()), Refusal::kEmergency);
}

}  // namespace
}  // namespace ols::station
