// The driver against the simulated unit: start, faults of the line, halts.
#include "edge/ptu/driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols::ptu {
namespace {

TEST(PtuDriver, StartsAUnitWithFactorySettings) {
  ClosedLoop loop(quick_driver(9600), quick_unit(9600));
  ASSERT_TRUE(loop.start());
  EXPECT_NEAR(degrees(loop.driver.limits().pan_max_rad), 2.7 * 180.0 / kPi, 1e-6);
  EXPECT_NEAR(degrees(loop.driver.limits().tilt_max_rad), 0.5 * 180.0 / kPi, 1e-6);
  EXPECT_NE(loop.driver.firmware().find("Pan-Tilt Controller v2"), std::string::npos);
  EXPECT_EQ(loop.driver.counters().errors, 0u);
  EXPECT_EQ(loop.driver.counters().restarts, 0u);
  EXPECT_EQ(loop.sent.substr(0, 4), " ED ");
}

TEST(PtuDriver, CountsEachStartButTheFirst) {
  ClosedLoop loop(quick_driver(), quick_unit());
  loop.driver.restart(0.0);
  EXPECT_EQ(loop.driver.counters().restarts, 0u);
  loop.driver.restart(1.0);
  EXPECT_EQ(loop.driver.counters().restarts, 1u);
}

TEST(PtuDriver, NarrowsItsLimitsToTheUnits) {
  PtuConfig config = quick_driver();
  config.limits = {-10.0, 10.0, -10.0, 10.0};
  ClosedLoop loop(config, quick_unit());
  ASSERT_TRUE(loop.start());
  EXPECT_NEAR(degrees(loop.driver.limits().pan_min_rad), -159.0, 0.01);
  EXPECT_NEAR(degrees(loop.driver.limits().tilt_max_rad), 31.0, 0.01);
}

TEST(PtuDriver, WaitsForAUnitThatHomesFirst) {
  sim::PtuUnitConfig unit = quick_unit();
  unit.home_at_power_up = true;
  ClosedLoop loop(quick_driver(), unit);
  EXPECT_FALSE(loop.start(2.0));
  EXPECT_TRUE(loop.start(40.0));
  EXPECT_GE(loop.driver.counters().restarts, 1u);
}

// edge/ptu/budget.h: at 9600 baud, in motion, the line carries a cycle in 74 ms at most; at rest in
// 48 ms.
TEST(PtuDriver, PollsAsFastAsTheLineAllows) {
  ClosedLoop loop(quick_driver(9600), quick_unit(9600));
  ASSERT_TRUE(loop.start());
  loop.run(0.2);
  loop.driver.take_samples();
  loop.run(2.0);
  EXPECT_GT(loop.driver.take_samples().size(), 40u);  // 2 s / 48 ms; numbers are short at zero
  const double begin_s = loop.time_s;
  loop.run(2.0, [&] {
    const double t = loop.time_s - begin_s;
    loop.driver.set_goal(loop.goal({0.3 * t, -0.2 * t}, {0.3, -0.2}));
  });
  const auto moving = loop.driver.take_samples().size();
  EXPECT_GE(moving, 27u);  // 2 s / 74 ms
  EXPECT_LT(moving, 42u);
  EXPECT_EQ(loop.driver.counters().timeouts, 0u);
  EXPECT_EQ(loop.driver.counters().garbled, 0u);
}

// On a loaded host requests go out up to 15 ms late: no reason to doubt the positions.
TEST(PtuDriver, IsNotDisturbedByALoadedHost) {
  for (const int baud : {9600, 38400}) {
    ClosedLoop loop(quick_driver(baud), quick_unit(baud));
    ASSERT_TRUE(loop.start());
    std::mt19937 random(8);
    std::uniform_real_distribution<double> late_s(0.0, 0.015);
    loop.late_s = [&] { return late_s(random); };
    const double begin_s = loop.time_s;
    loop.run(6.0, [&] {
      const double pan_rad = radians(20.0) * (loop.time_s - begin_s);
      loop.driver.set_goal(loop.goal({pan_rad, 0.0}, {radians(20.0), 0.0}));
    });
    EXPECT_EQ(loop.driver.counters().garbled, 0u) << loop.driver.last_error();
    EXPECT_EQ(loop.driver.counters().timeouts, 0u);
  }
}

TEST(PtuDriver, BacksOffFromADeadLine) {
  ClosedLoop loop(quick_driver(), quick_unit());
  loop.cut = true;
  loop.run(60.0);
  EXPECT_LT(loop.driver.counters().restarts, 45u);
  EXPECT_GE(loop.driver.counters().restarts, 30u);
}

// Echo and verbose replies come on in mid-run: switched off again, and nothing else happens.
TEST(PtuDriver, SwitchesEchoOffAgainWithoutANewStart) {
  ClosedLoop loop(quick_driver(), quick_unit());
  ASSERT_TRUE(loop.start());
  const double begin_s = loop.time_s;
  const auto follow = [&] {
    const double t = loop.time_s - begin_s;
    loop.driver.set_goal(loop.goal({0.3 * t, 0.0}, {0.3, 0.0}));
  };
  loop.run(2.0, follow);
  loop.unit.receive("EE FV ", loop.time_s);
  loop.sent.clear();
  loop.run(0.5, follow);
  EXPECT_NE(loop.sent.find("ED "), std::string::npos);
  EXPECT_NE(loop.sent.find("FT "), std::string::npos);
  EXPECT_EQ(loop.driver.counters().echoes, 1u);
  EXPECT_EQ(loop.driver.counters().restarts, 0u);
  loop.driver.take_samples();
  loop.sent.clear();
  loop.run(1.0, follow);
  EXPECT_EQ(loop.sent.find("ED"), std::string::npos);
  EXPECT_GT(loop.driver.take_samples().size(), 35u);
  EXPECT_NEAR(loop.truth().pan_rad, 0.3 * (loop.time_s - begin_s), radians(0.1));
}

// The same, but the unit has also lost its acceleration: it was switched off and on, unnoticed.
TEST(PtuDriver, BeginsAgainWhenTheUnitHasForgottenMoreThanItsEcho) {
  ClosedLoop loop(quick_driver(), quick_unit());
  ASSERT_TRUE(loop.start());
  loop.run(0.3);
  loop.unit.receive("EE FV PA2000 ", loop.time_s);
  loop.run(0.8);
  EXPECT_GE(loop.driver.counters().restarts, 1u);
  loop.run(5.0);
  EXPECT_EQ(loop.driver.doubt(), PtuDoubtCause::kPowerCycle);
  EXPECT_TRUE(loop.driver.take_samples().empty());
  loop.driver.reference_ok();
  ASSERT_EQ(loop.driver.state(), PtuState::kReady);
  loop.run(0.5);
  EXPECT_GT(loop.driver.take_samples().size(), 15u);
}

TEST(PtuDriver, GivesUpOnAUnitWithoutAResolution) {
  PtuDriver driver(quick_driver());
  std::string line;
  double t = 1.0;
  bool faulted = false;
  for (int i = 0; i < 3000; ++i, t += 1e-3) {
    const std::string request = driver.step(t);
    const auto commands = std::count_if(request.begin() + (request.empty() ? 0 : 1), request.end(),
                                        [](char c) { return c == ' '; });
    const char* reply = request == "C " ? "* i\r\n" : "* 0\r\n";
    for (auto n = commands; n > 0; --n) driver.receive(reply, t);
    faulted = faulted || driver.state() == PtuState::kFault;
  }
  EXPECT_TRUE(faulted);
  EXPECT_NE(driver.last_error().find("PR"), std::string::npos);
}

// The unit is in velocity mode, as another master may have left it, and one command does not reach
// it or gets another answer.
struct StartCase {
  const char* command;
  const char* answer;  // the command is kept from the unit and answered so; empty: not so
  const char* reason;  // within last_error(); empty: the unit is to become ready
};

void start_from_velocity_mode(const StartCase& c) {
  sim::PtuUnit unit(quick_unit(), 7, 10.0);
  PtuDriver driver(quick_driver());
  bool faulted = false, ready = false, moved = false;
  const std::string tampered = std::string(c.command) + " ";
  for (double t = 10.0; t < 14.0; t += 1e-3) {
    if (t < 10.0005) unit.receive("CV ", t);
    const std::string request = driver.step(t);
    if (request == tampered && *c.answer != '\0') {
      driver.receive(c.answer, t + 5e-4);
    } else if (!request.empty()) {
      unit.receive(request, t);
    }
    driver.receive(unit.transmit(t), t);
    faulted = faulted || driver.state() == PtuState::kFault;
    ready = ready || driver.state() == PtuState::kReady;
    driver.set_goal(mount::Goal{t, {1.0, 0.0}, {}, t + 0.5});
    moved = moved || std::abs(unit.angles_at(t).pan_rad) > 1e-3;
  }
  const bool drives = *c.reason == '\0';
  EXPECT_EQ(ready, drives) << c.command << c.answer;
  EXPECT_EQ(moved, drives) << c.command << c.answer;
  EXPECT_EQ(faulted, !drives) << c.command << c.answer;
  EXPECT_NE(driver.last_error().find(c.reason), std::string::npos) << driver.last_error();
}

TEST(PtuDriver, DrivesNoUnitThatMayTakeSpeedsForVelocities) {
  constexpr const char* kReason = "may be in velocity mode";
  for (const StartCase& c :
       {StartCase{"CI", "! Illegal Command Entered\r\n", kReason},
        StartCase{"CI", "*\r\n", kReason}, StartCase{"C", "* p\r\n", kReason},
        StartCase{"C", "*\r\n", kReason},
        StartCase{"C", "* PTU is in Pure Velocity Mode\r\n", kReason},
        StartCase{"C", "! Illegal Command Entered\r\n", kReason}, StartCase{"C", "", ""},
        StartCase{"C", "* I\r\n", ""}, StartCase{"C", "* PTU is in Independent Mode\r\n", ""},
        StartCase{"C", "* Independent speed control mode\r\n", ""}}) {
    start_from_velocity_mode(c);
  }
}

TEST(PtuDriver, DrivesNoUnitThatRefusesItsSoftLimits) {
  start_from_velocity_mode({"LE", "! Illegal Command Entered\r\n", "soft limits"});
}

TEST(PtuDriver, FaultsWhenNoPositionIsWithinBothLimits) {
  struct Case {
    mount::Limits limits;
    const char* axis;
  };
  const double count = radians(11.5714 / 3600.0);
  for (const auto& [limits, axis] :
       {Case{{-2.7, 2.7, radians(40.0), radians(60.0)}, "tilt"},
        Case{{-2.7, 2.7, radians(-90.0), radians(-60.0)}, "tilt"},
        Case{{radians(170.0), radians(300.0), -0.8, 0.5}, "pan"},
        Case{{1e9, 2e9, -0.8, 0.5}, "pan"},
        Case{{10.2 * count, 10.8 * count, -0.8, 0.5}, "pan"}}) {  // between two counts
    PtuConfig config = quick_driver();
    config.limits = limits;
    ClosedLoop loop(config, quick_unit());
    bool faulted = false;
    loop.run(3.0, [&] {
      loop.driver.set_goal(loop.goal({1.0, 0.3}));
      faulted = faulted || loop.driver.state() == PtuState::kFault;
      ASSERT_NE(loop.driver.state(), PtuState::kReady);
    });
    EXPECT_TRUE(faulted);
    EXPECT_NE(loop.driver.last_error().find(std::string("no ") + axis + " lies within both"),
              std::string::npos)
        << loop.driver.last_error();
    EXPECT_DOUBLE_EQ(loop.truth().pan_rad, 0.0);
    EXPECT_DOUBLE_EQ(loop.truth().tilt_rad, 0.0);
  }
}

}  // namespace
}  // namespace ols::ptu
