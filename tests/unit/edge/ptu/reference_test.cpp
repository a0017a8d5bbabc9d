// What a unit's angles are worth after it lost its power or ran into a limit, and how the reference
// comes back.
#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols::ptu {
namespace {

constexpr double kWrong_rad = 1e-3;

class Reference : public testing::Test {
 protected:
  void make(bool homes, const PtuConfig& driver = quick_driver(38400), int unit_baud = 9600) {
    sim::PtuUnitConfig unit = quick_unit(unit_baud);
    unit.home_at_power_up = homes;
    loop_ = std::make_unique<ClosedLoop>(driver, unit);
    run(homes ? 60.0 : 8.0);
    ASSERT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
    ASSERT_EQ(loop_->driver.doubt(), std::nullopt);
    send_to(20.0, 4.0);
    ASSERT_NEAR(degrees(loop_->truth().pan_rad), 20.0, 0.01);
  }

  // With the port at the driver's rate, as the thread has it; judges every sample.
  void run(double duration_s, const std::function<void()>& each = {}) {
    loop_->run(duration_s, [&] {
      loop_->unit.set_master_baud(loop_->driver.line_baud());
      if (each) each();
      for (const mount::AngleSample& sample : loop_->driver.take_samples()) {
        const PanTilt truth = loop_->unit.angles_at(sample.time_s);
        wrong_ += std::abs(sample.angles.pan_rad - truth.pan_rad) > kWrong_rad ? 1 : 0;
        ++samples_;
      }
    });
  }
  void send_to(double pan_deg, double duration_s) {
    run(duration_s, [&] { loop_->driver.set_goal(loop_->goal({radians(pan_deg), 0.0})); });
  }
  double pan_deg() const { return degrees(loop_->truth().pan_rad); }

  std::unique_ptr<ClosedLoop> loop_;
  int wrong_ = 0, samples_ = 0;
};

TEST_F(Reference, NoAngleAndNoMotionAfterAPowerCycleWithoutHoming) {
  make(false);
  loop_->unit.power_cycle(loop_->time_s);
  samples_ = 0;
  send_to(-30.0, 15.0);
  EXPECT_GE(loop_->driver.counters().power_cycles, 1u);
  EXPECT_EQ(loop_->driver.state(), PtuState::kFault);
  EXPECT_EQ(loop_->driver.reference(),
            mount::Reference::kMissing);  // its gears are not known either
  EXPECT_TRUE(loop_->driver.not_referenced());
  loop_->driver.reference_ok();
  EXPECT_NE(loop_->driver.doubt(), std::nullopt);
  EXPECT_NE(loop_->driver.last_error().find("lost power"), std::string::npos);
  EXPECT_EQ(samples_, 0);
  EXPECT_NEAR(pan_deg(), 20.0, 0.01);
}

TEST_F(Reference, ComesBackByHoming) {
  make(false);
  loop_->unit.power_cycle(loop_->time_s);
  run(10.0);
  loop_->driver.home(loop_->time_s);
  EXPECT_EQ(loop_->driver.state(), PtuState::kStarting);
  EXPECT_EQ(loop_->driver.reference(), mount::Reference::kMissing);
  samples_ = 0;
  run(60.0);
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
  EXPECT_EQ(loop_->driver.counters().homings, 1u);
  EXPECT_GT(samples_, 100);
  send_to(-30.0, 4.0);
  EXPECT_NEAR(pan_deg(), -30.0, 0.01);
  EXPECT_EQ(wrong_, 0);
}

TEST_F(Reference, ComesBackByTheUnitsOwnHoming) {
  for (const int baud : {9600, 38400}) {  // with the rate forgotten or kept
    for (const double later_s : {0.0, 0.4, 0.9, 1.3}) {
      make(true, quick_driver(38400), baud);
      run(later_s);
      loop_->unit.power_cycle(loop_->time_s);
      run(70.0);
      EXPECT_GE(loop_->driver.counters().power_cycles, 1u);
      EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
      EXPECT_EQ(loop_->driver.doubt(), std::nullopt);
      send_to(-30.0, 4.0);
      EXPECT_NEAR(pan_deg(), -30.0, 0.01);
      EXPECT_EQ(wrong_, 0);
    }
  }
}

TEST_F(Reference, ComesBackBecauseAPersonVouchesForIt) {
  make(false);
  loop_->driver.receive("!P", loop_->time_s);
  run(10.0);
  ASSERT_EQ(loop_->driver.reference(), mount::Reference::kDoubted);
  loop_->driver.reference_ok();
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady);
  samples_ = 0;
  run(1.0);
  EXPECT_GT(samples_, 20);
}

TEST_F(Reference, ComesBackByItselfWhereTheConfigurationAllowsHoming) {
  PtuConfig config = quick_driver(38400);
  config.rehome = PtuRehome::kWhenUnreferenced;
  make(false, config);
  loop_->unit.power_cycle(loop_->time_s);
  run(70.0);
  EXPECT_EQ(loop_->driver.counters().homings, 1u);
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
  EXPECT_EQ(wrong_, 0);
}

TEST_F(Reference, IsDoubtedAfterALimitHit) {
  make(false);
  const std::uint64_t restarts = loop_->driver.counters().restarts;
  loop_->driver.receive("!P", loop_->time_s);
  run(0.1);
  samples_ = 0;
  send_to(-30.0, 3.0);
  EXPECT_EQ(loop_->driver.state(), PtuState::kFault);
  EXPECT_EQ(loop_->driver.doubt(), PtuDoubtCause::kLimitHit);
  EXPECT_NE(loop_->driver.last_error().find("limit"), std::string::npos);
  EXPECT_EQ(samples_, 0);
  EXPECT_NEAR(pan_deg(), 20.0, 0.01);
  EXPECT_EQ(loop_->driver.counters().restarts, restarts);
  loop_->driver.home(loop_->time_s);
  run(60.0);
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
}

// In motion: it stands before it homes.
TEST_F(Reference, HomesOnlyAUnitThatStands) {
  make(false);
  run(1.0, [&] { loop_->driver.set_goal(loop_->goal({radians(120.0), 0.0})); });
  loop_->sent.clear();
  loop_->driver.home(loop_->time_s);
  double last_rad = loop_->truth().pan_rad, speed = 1.0;
  while (loop_->sent.find(" R ") == std::string::npos) {
    run(0.05);
    speed = std::abs(loop_->truth().pan_rad - last_rad) / 0.05;
    last_rad = loop_->truth().pan_rad;
  }
  EXPECT_LT(degrees(speed), 1.0);
  EXPECT_LT(loop_->sent.find("H "), loop_->sent.find(" R "));
}

// A homing long after its command would be unexpected.
TEST_F(Reference, ForgetsToHomeAUnitThatDoesNotAnswer) {
  make(false);
  loop_->cut = true;
  loop_->driver.home(loop_->time_s);
  run(6.0);
  loop_->cut = false;
  loop_->sent.clear();
  run(20.0);
  EXPECT_EQ(loop_->sent.find(" R "), std::string::npos);
  EXPECT_EQ(loop_->driver.counters().homings, 0u);
}

TEST_F(Reference, NoHomingInAnEmergencyAndNoTrustInOneThatWasInterrupted) {
  make(false);
  loop_->unit.receive(loop_->driver.emergency_halt(loop_->time_s), loop_->time_s);
  loop_->driver.home(loop_->time_s);
  run(5.0);
  EXPECT_EQ(loop_->driver.counters().homings, 0u);
  loop_->driver.clear_emergency();
  loop_->driver.home(loop_->time_s);
  run(3.0);
  EXPECT_EQ(loop_->driver.counters().homings, 1u);
  loop_->unit.receive(loop_->driver.emergency_halt(loop_->time_s), loop_->time_s);
  run(1.0);
  EXPECT_EQ(loop_->driver.doubt(), PtuDoubtCause::kHomingInterrupted);
}

// The simulated unit does not heed a halt while it homes; a real one may.
class BrokenHoming : public Reference, public testing::WithParamInterface<double> {};

TEST_P(BrokenHoming, IsNoReferenceHoweverFarItCame) {
  PtuConfig config = quick_driver(38400);
  config.rehome = PtuRehome::kWhenUnreferenced;
  make(false, config);
  loop_->driver.home(loop_->time_s);
  run(GetParam());
  ASSERT_EQ(loop_->driver.counters().homings, 1u);
  ASSERT_TRUE(loop_->driver.homing());
  EXPECT_EQ(to_word(loop_->driver.doubt_to_persist()), "homing");
  loop_->sent.clear();
  loop_->driver.stop_homing(loop_->time_s);
  run(0.01);
  EXPECT_EQ(loop_->sent.substr(0, 3), " H ");
  samples_ = 0;
  run(40.0);  // until the unit is done and answers again
  EXPECT_EQ(loop_->driver.doubt(), PtuDoubtCause::kHomingInterrupted);
  EXPECT_EQ(loop_->driver.reference(), mount::Reference::kDoubted);
  EXPECT_EQ(samples_, 0);
  EXPECT_EQ(loop_->driver.counters().homings, 1u);  // not again by itself
  loop_->driver.home(loop_->time_s);
  run(60.0);
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
}
INSTANTIATE_TEST_SUITE_P(AfterSeconds, BrokenHoming, testing::Values(1.0, 4.0, 8.0, 12.0, 16.0));

TEST_F(Reference, IsLostWithThePortInTheMiddleOfAHoming) {
  make(false);
  loop_->driver.home(loop_->time_s);
  run(4.0);
  ASSERT_TRUE(loop_->driver.homing());
  loop_->driver.restart(loop_->time_s);
  run(40.0);
  EXPECT_EQ(loop_->driver.doubt(), PtuDoubtCause::kHomingInterrupted);
}

TEST_F(Reference, AStrayReplyDoesNotEndAHoming) {
  make(false);
  loop_->driver.home(loop_->time_s);
  while (loop_->sent.find(" R ") == std::string::npos) run(0.01);
  loop_->driver.receive("*\r\n", loop_->time_s);
  run(5.0);
  EXPECT_TRUE(loop_->driver.homing());
  run(55.0);
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
  EXPECT_EQ(wrong_, 0);
}

// It answers as one does that was just switched on, and was not homed.
TEST(FirstStart, DoubtsAUnitThatDoesNotHomeAtPowerUp) {
  for (const bool homes : {true, false}) {
    PtuConfig config = quick_driver(38400);
    config.homes_at_power_up = homes;
    ClosedLoop loop(config, quick_unit(9600));
    loop.run(8.0);
    EXPECT_EQ(loop.driver.reference(),
              homes ? mount::Reference::kTrusted : mount::Reference::kDoubted);
  }
}

TEST_F(Reference, AStopCallsOffAHomingThatWaitsForTheUnitToStand) {
  make(false);
  run(1.0, [&] { loop_->driver.set_goal(loop_->goal({radians(120.0), 0.0})); });
  loop_->driver.home(loop_->time_s);
  loop_->driver.stop_homing(loop_->time_s);
  run(10.0);
  EXPECT_EQ(loop_->driver.counters().homings, 0u);
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
  loop_->sent.clear();
  loop_->driver.stop_homing(loop_->time_s);  // nothing homes: nothing is disturbed
  run(0.5);
  EXPECT_EQ(loop_->sent.find("H "), std::string::npos);
}

TEST_F(Reference, HomesByItselfOnlyWhenItMay) {
  PtuConfig config = quick_driver(38400);
  config.rehome = PtuRehome::kWhenUnreferenced;
  make(false, config);
  loop_->driver.allow_rehoming(false);  // an operator has stopped the station
  loop_->driver.receive("!P", loop_->time_s);
  run(10.0);
  EXPECT_EQ(loop_->driver.doubt(), PtuDoubtCause::kLimitHit);
  EXPECT_EQ(loop_->driver.counters().homings, 0u);
  loop_->driver.allow_rehoming(true);
  run(60.0);
  EXPECT_EQ(loop_->driver.counters().homings, 1u);
  EXPECT_EQ(loop_->driver.state(), PtuState::kReady) << loop_->driver.last_error();
}

// Never "starting" again between two attempts.
TEST_F(Reference, ADeadLineIsAFaultAllTheTime) {
  make(false);
  loop_->cut = true;
  run(1.0);
  int others = 0;
  run(20.0, [&] { others += loop_->driver.state() == PtuState::kFault ? 0 : 1; });
  EXPECT_EQ(others, 0);
}

TEST(FirstStart, IsAFaultFromTheFirstFailureOn) {
  ClosedLoop loop(quick_driver(), quick_unit());
  loop.cut = true;
  loop.run(0.3);
  EXPECT_EQ(loop.driver.state(), PtuState::kStarting);
  loop.run(1.0);
  int others = 0;
  loop.run(10.0, [&] { others += loop.driver.state() == PtuState::kFault ? 0 : 1; });
  EXPECT_EQ(others, 0);
}

// Its acceleration cannot be set and it keeps 10 deg/s^2.
TEST(SlowUnit, IsDrivenSoThatItStopsWithinASecond) {
  sim::PtuUnitConfig unit = quick_unit();
  const double step_rad = radians(unit.resolution_arcsec / 3600.0);
  unit.acceleration_counts_s2 = static_cast<int>(radians(10.0) / step_rad);
  ClosedLoop loop(quick_driver(), unit);
  loop.change_request = [](std::string& request) {
    if (request.starts_with("PA1") || request.starts_with("TA1")) request = "XX ";
  };
  ASSERT_TRUE(loop.start()) << loop.driver.last_error();
  ASSERT_TRUE(loop.driver.lowered_speed());
  EXPECT_NEAR(degrees(loop.driver.lowered_speed()->speed_rad_s), 10.0 * 2.0 / 3.0, 0.01);
  EXPECT_NEAR(degrees(loop.driver.lowered_speed()->acceleration_rad_s2), 10.0, 0.01);
  loop.run(3.0, [&] {
    loop.driver.set_goal(loop.goal({radians(100.0), 0.0}, {radians(20.0), 0.0}));
  });
  loop.cut = true;  // this master is dead
  const double dead_s = loop.time_s;
  double moved_s = dead_s, last_rad = loop.truth().pan_rad;
  loop.run(4.0, [&] {
    if (loop.truth().pan_rad != last_rad) moved_s = loop.time_s;
    last_rad = loop.truth().pan_rad;
  });
  EXPECT_GT(moved_s - dead_s, 0.3);
  EXPECT_LE(moved_s - dead_s, 1.05);
}

TEST(SlowUnit, NothingIsLoweredWhenTheUnitDoesAsItIsTold) {
  ClosedLoop loop(quick_driver(), quick_unit());
  ASSERT_TRUE(loop.start());
  EXPECT_FALSE(loop.driver.lowered_speed());
}

}  // namespace
}  // namespace ols::ptu
