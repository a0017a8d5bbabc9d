// Units that are found at another rate, lose their power, do not know where they are, are stopped.
#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols::ptu {
namespace {

bool moves_commanded(const std::string& sent) {
  for (const char* command : {"PP", "TP", "PO", "TO"}) {
    for (std::size_t at = sent.find(command); at != std::string::npos;
         at = sent.find(command, at + 1)) {
      const char next = at + 2 < sent.size() ? sent[at + 2] : ' ';
      if (next == '-' || (next >= '0' && next <= '9')) return true;
    }
  }
  return false;
}

// The port is set to the driver's rate, as the thread does.
void run_with_rates(ClosedLoop& loop, double duration_s, const std::function<void()>& each = {}) {
  loop.run(duration_s, [&] {
    loop.unit.set_master_baud(loop.driver.line_baud());
    if (each) each();
  });
}

TEST(Recovery, FindsAUnitAtItsFactoryRateAndTellsItTheWantedOne) {
  ClosedLoop loop(quick_driver(38400), quick_unit(9600));
  run_with_rates(loop, 8.0);
  EXPECT_EQ(loop.driver.state(), PtuState::kReady) << loop.driver.last_error();
  EXPECT_EQ(loop.driver.line_baud(), 38400);
  EXPECT_NE(loop.sent.find("@(38400,0,F)"), std::string::npos);
  loop.driver.take_samples();
  run_with_rates(loop, 1.0);
  EXPECT_GT(loop.driver.take_samples().size(), 35u);
}

TEST(Recovery, FindsAUnitThatHasTheWantedRateAlready) {
  PtuConfig config = quick_driver(38400);
  config.line_baud = 115200;
  ClosedLoop loop(config, quick_unit(38400));
  run_with_rates(loop, 3.0);
  EXPECT_EQ(loop.driver.state(), PtuState::kReady);
  EXPECT_EQ(loop.sent.find('@'), std::string::npos);
}

TEST(Recovery, OfBothModels) {
  for (const sim::PtuModel model : {sim::PtuModel::kD46, sim::PtuModel::kE46}) {
    sim::PtuUnitConfig unit = quick_unit();
    unit.model = model;
    PtuConfig config = quick_driver();
    config.hold_power = 'R';
    config.move_power = 'H';
    ClosedLoop loop(config, unit);
    ASSERT_TRUE(loop.start()) << loop.driver.last_error();
    EXPECT_EQ(ptu_model(loop.driver.firmware()),
              model == sim::PtuModel::kD46 ? PtuModel::kClassic : PtuModel::kESeries);
    loop.run(1.0);
    ASSERT_TRUE(loop.driver.environment());
    EXPECT_GT(loop.driver.environment()->supply_V, 5.0);
    EXPECT_EQ(loop.driver.environment()->pan_degC.has_value(), model == sim::PtuModel::kE46);
    EXPECT_EQ(loop.driver.counters().errors, 0u) << loop.driver.last_error();
  }
}

// The scale of the counts follows from what the unit says.
TEST(Recovery, StepModeOfAnESeriesUnit) {
  sim::PtuUnitConfig unit = quick_unit();
  unit.model = sim::PtuModel::kE46;
  PtuConfig config = quick_driver();
  config.step_mode = 'H';
  ClosedLoop loop(config, unit);
  ASSERT_TRUE(loop.start()) << loop.driver.last_error();
  EXPECT_NE(loop.sent.find("WPH WTH"), std::string::npos);
  loop.run(4.0, [&] { loop.driver.set_goal(loop.goal({radians(10.0), radians(-5.0)})); });
  EXPECT_NEAR(degrees(loop.truth().pan_rad), 10.0, 0.02);
  EXPECT_NEAR(degrees(loop.truth().tilt_rad), -5.0, 0.02);
}

// Whether it homes itself then or not; what comes of that: reference_test.cpp.
TEST(Recovery, NoOldGoalAfterAPowerCycle) {
  for (const bool homes : {false, true}) {
    sim::PtuUnitConfig unit = quick_unit(9600);
    unit.home_at_power_up = homes;
    ClosedLoop loop(quick_driver(38400), unit);
    run_with_rates(loop, homes ? 60.0 : 8.0);
    ASSERT_EQ(loop.driver.state(), PtuState::kReady);
    run_with_rates(loop, 4.0, [&] { loop.driver.set_goal(loop.goal({radians(20.0), 0.0})); });
    ASSERT_NEAR(degrees(loop.truth().pan_rad), 20.0, 0.01);
    EXPECT_EQ(loop.driver.counters().power_cycles, 0u);
    mount::Goal lasting = loop.goal({radians(20.0), 0.0});
    lasting.valid_until_s = loop.time_s + 1000.0;
    loop.driver.set_goal(lasting);
    loop.unit.power_cycle(loop.time_s);
    loop.sent.clear();
    run_with_rates(loop, homes ? 60.0 : 10.0);
    EXPECT_GE(loop.driver.counters().restarts, 1u);
    EXPECT_GE(loop.driver.counters().power_cycles, 1u);
    const std::string since_noticed =
        loop.sent.substr(std::min(loop.sent.find(" H "), loop.sent.size()));
    EXPECT_FALSE(moves_commanded(since_noticed)) << since_noticed.substr(0, 200);
  }
}

// Whenever the line comes back, and though the other rate is tried in between.
TEST(Recovery, ALineThatIsWholeAgainIsHealedSoon) {
  for (const double cut_s : {1.0, 2.3, 5.0, 7.7, 20.0}) {
    ClosedLoop loop(quick_driver(38400), quick_unit(38400));
    ASSERT_TRUE(loop.start());
    const auto with_cut = [&](std::string& bytes) {
      if (loop.cut) bytes.clear();
    };
    loop.garble = with_cut;
    loop.cut = true;
    run_with_rates(loop, cut_s);
    loop.cut = false;
    const double whole_s = loop.time_s;
    while (loop.driver.state() != PtuState::kReady && loop.time_s < whole_s + 10.0) {
      run_with_rates(loop, 0.01);
    }
    EXPECT_LT(loop.time_s - whole_s, 4.0) << cut_s;
  }
}

TEST(Recovery, NoOldGoalAfterTheLineWasCut) {
  ClosedLoop loop(quick_driver(), quick_unit());
  ASSERT_TRUE(loop.start());
  loop.run(0.6, [&] { loop.driver.set_goal(loop.goal({radians(100.0), 0.0})); });
  mount::Goal lasting = loop.goal({radians(100.0), 0.0});
  lasting.valid_until_s = loop.time_s + 1000.0;
  lasting.time_s = loop.time_s;
  loop.driver.set_goal(lasting);
  loop.cut = true;
  loop.run(5.0);
  EXPECT_TRUE(loop.driver.take_link_loss());
  EXPECT_FALSE(loop.driver.take_link_loss());
  loop.cut = false;
  loop.sent.clear();
  ASSERT_TRUE(loop.start(15.0));
  const double at_rad = loop.truth().pan_rad;
  loop.run(3.0);
  EXPECT_EQ(loop.truth().pan_rad, at_rad);
  EXPECT_FALSE(moves_commanded(loop.sent));
  EXPECT_NE(loop.sent.find("H "), std::string::npos);
}

TEST(Recovery, AUnitThatWasNotHomedIsHomedOnlyWhenAllowed) {
  sim::PtuUnitConfig unit = quick_unit();
  unit.model = sim::PtuModel::kE46;
  unit.homed_before = false;
  for (const bool allowed : {false, true}) {
    PtuConfig config = quick_driver();
    config.rehome = allowed ? PtuRehome::kWhenUnreferenced : PtuRehome::kNever;
    ClosedLoop loop(config, unit);
    bool warned = false;
    double furthest_rad = 0.0;
    loop.run(80.0, [&] {
      loop.driver.set_goal(loop.goal({radians(1.0), 0.0}));
      warned = warned || loop.driver.not_referenced();
      furthest_rad = std::max(furthest_rad, std::abs(loop.truth().pan_rad));
    });
    EXPECT_TRUE(warned);
    EXPECT_EQ(loop.driver.counters().homings, allowed ? 1u : 0u);
    if (allowed) {
      EXPECT_EQ(loop.driver.state(), PtuState::kReady) << loop.driver.last_error();
      EXPECT_NEAR(degrees(loop.truth().pan_rad), 1.0, 0.01);
    } else {
      EXPECT_LT(degrees(furthest_rad), 0.1);
      EXPECT_EQ(loop.sent.find(" R "), std::string::npos);
    }
  }
}

// The unit's travel has become less than it said: one refusal may be noise, several are not.
TEST(Recovery, AsksForTheBoundsAgainWhenTheUnitRefusesThem) {
  ClosedLoop loop(quick_driver(), quick_unit());
  ASSERT_TRUE(loop.start());
  bool refuse = true;
  loop.garble = [&](std::string& bytes) {
    const auto at = bytes.find("*\r");
    if (refuse && loop.driver.state() == PtuState::kReady && at != std::string::npos) {
      bytes.replace(at, 1, "! Maximum allowable Pan position is 3090");
    }
  };
  loop.run(2.0, [&] {
    loop.driver.set_goal(loop.goal({0.5, 0.0}));
    refuse = loop.driver.counters().restarts == 0;
  });
  EXPECT_GE(loop.driver.counters().restarts, 1u);
  EXPECT_GE(loop.driver.counters().errors, 3u);
  EXPECT_NE(loop.driver.last_error().find("bounds have changed"), std::string::npos)
      << loop.driver.last_error();
}

TEST(Emergency, HaltsAtOnceAndKeepsItUntilCleared) {
  PtuConfig config = quick_driver();
  config.acceleration_rad_s2 = radians(60.0);
  ClosedLoop loop(config, quick_unit());
  ASSERT_TRUE(loop.start());
  const auto chase = [&] {
    loop.driver.set_goal(loop.goal({radians(150.0), 0.0}, {radians(20.0), 0.0}));
  };
  loop.run(1.0, chase);
  loop.sent.clear();
  const double stop_s = loop.time_s;
  loop.unit.receive(loop.driver.emergency_halt(stop_s), stop_s);
  double moved_until_s = stop_s;
  double last_rad = loop.truth().pan_rad;
  loop.run(10.0, [&] {
    chase();
    if (loop.truth().pan_rad != last_rad) moved_until_s = loop.time_s;
    last_rad = loop.truth().pan_rad;
  });
  EXPECT_LE(moved_until_s - stop_s, 1.0 + 0.05);  // from up to 57 deg/s
  EXPECT_FALSE(moves_commanded(loop.sent));
  EXPECT_NE(loop.sent.find("H "), std::string::npos);  // once more, until it was seen to stand
  EXPECT_TRUE(loop.driver.in_emergency());
  EXPECT_TRUE(loop.driver.standing());
  EXPECT_EQ(loop.driver.counters().emergencies, 1u);
  EXPECT_EQ(loop.driver.counters().restarts, 0u);
  // Released: the unit still does not move before it is given a goal.
  loop.driver.clear_emergency();
  loop.run(1.0);
  EXPECT_EQ(loop.truth().pan_rad, last_rad);
  loop.run(0.5, chase);
  EXPECT_GT(loop.truth().pan_rad, last_rad);
}

TEST(Emergency, HoldsThroughALostLineAndAPowerCycle) {
  ClosedLoop loop(quick_driver(), quick_unit());
  ASSERT_TRUE(loop.start());
  loop.unit.receive(loop.driver.emergency_halt(loop.time_s), loop.time_s);
  const auto chase = [&] { loop.driver.set_goal(loop.goal({radians(50.0), 0.0})); };
  loop.cut = true;
  loop.run(3.0, chase);
  loop.cut = false;
  loop.unit.power_cycle(loop.time_s);
  loop.run(15.0, [&] {
    loop.unit.set_master_baud(loop.driver.line_baud());
    chase();
  });
  EXPECT_TRUE(loop.driver.in_emergency());
  EXPECT_FALSE(moves_commanded(loop.sent));
  EXPECT_DOUBLE_EQ(loop.truth().pan_rad, 0.0);
}

}  // namespace
}  // namespace ols::ptu
