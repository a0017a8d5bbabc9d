// What a station makes of its emergency stop: its whole process in simulated time.
#include <csignal>

#include "edge/command/rearm_signal.h"
#include "tests/unit/edge/process/station_in_simulated_time.h"

namespace ols::station {
namespace {

using test::Command;
using Status = ols_msg::station_status_t;
constexpr const char* kNotRearmed = "emergency stop: not rearmed yet: hold its re-arm button";

class EmergencyStop : public test::StationInSimulatedTime {
 protected:
  EmergencyStop() : StationInSimulatedTime(with_stop()) { install_rearm_handler(); }

  static sim::Scenario with_stop() {
    sim::Scenario s = scenario();
    s.gpio.on = true;
    return s;
  }
  void set(bool pressed, bool rearm_held = false) {
    sim::StationFaults faults;
    faults.stop_pressed = pressed;
    faults.rearm_held = rearm_held;
    station_->set_faults(faults);
  }
  bool comes_to(std::int8_t state) {
    return time_.pass(test::kPatience_s, [&] { return status_.state == state; });
  }
  // Nobody moves it from afar, whatever he sends and however often.
  bool stays_halted() {
    const double there_rad = station_->angles().pan_rad;
    for (int i = 0; i < 3; ++i) {
      EXPECT_FALSE(give(Command::COMMAND_REARM));
      EXPECT_FALSE(give(Command::COMMAND_POINT, -0.3));
      EXPECT_FALSE(give(Command::COMMAND_RELEASE));
    }
    EXPECT_TRUE(give(Command::COMMAND_STOP));
    time_.pass(2.0);
    return status_.state == Status::STATE_EMERGENCY && station_->angles().pan_rad == there_rad;
  }
};

TEST_F(EmergencyStop, HaltsTheUnitUntilItIsReleasedAndAHandRearms) {
  EXPECT_TRUE(give(Command::COMMAND_POINT, 2.0));
  EXPECT_TRUE(time_.pass(test::kPatience_s, [this] { return station_->angles().pan_rad > 0.4; }));
  set(true);
  EXPECT_TRUE(comes_to(Status::STATE_EMERGENCY));
  EXPECT_TRUE(says("emergency stop: pressed"));
  time_.pass(3.0);  // until it stands
  EXPECT_LT(station_->angles().pan_rad, 1.0);
  EXPECT_TRUE(stays_halted());
  set(true, true);
  std::raise(SIGUSR1);
  time_.pass(5.0);
  EXPECT_TRUE(stays_halted()) << "re-armed while it is pressed";
  set(false, true);
  EXPECT_TRUE(is_said(kNotRearmed));
  time_.pass(5.0);
  EXPECT_TRUE(stays_halted()) << "the button was held before the release";
  set(false);
  EXPECT_TRUE(stays_halted());
  set(false, true);
  time_.pass(0.5);
  set(false);
  EXPECT_TRUE(stays_halted()) << "the button was touched only";
  set(false, true);
  EXPECT_TRUE(comes_to(Status::STATE_STOPPED));
  set(false);
  EXPECT_TRUE(give(Command::COMMAND_POINT, -0.3));
  EXPECT_TRUE(time_.pass(test::kPatience_s, [this] { return station_->angles().pan_rad < -0.2; }));
}

TEST_F(EmergencyStop, OutlivesTheStationAsDoesWhatFollows) {
  set(true);
  EXPECT_TRUE(comes_to(Status::STATE_EMERGENCY));
  restart();
  EXPECT_TRUE(says("emergency stop: pressed"));
  set(false);
  EXPECT_TRUE(is_said(kNotRearmed));
  restart();
  EXPECT_EQ(status_.state, +Status::STATE_EMERGENCY);
  EXPECT_TRUE(is_said(kNotRearmed));
  EXPECT_TRUE(stays_halted());
  std::raise(SIGUSR1);  // who is logged in on its computer
  EXPECT_TRUE(comes_to(Status::STATE_STOPPED));
  restart();
  EXPECT_EQ(status_.state, +Status::STATE_STOPPED);
  EXPECT_TRUE(give(Command::COMMAND_RELEASE));
  EXPECT_TRUE(comes_to(Status::STATE_IDLE));
  restart();
  EXPECT_TRUE(comes_to(Status::STATE_IDLE));
}

}  // namespace
}  // namespace ols::station
