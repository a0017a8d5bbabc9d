// What a station makes of its emergency stop: its whole process in simulated time.
#include <csignal>
#include <filesystem>
#include <fstream>

#include "edge/command/rearm_signal.h"
#include "ols_msg/slew_t.hpp"
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
  // Its slews are refused, as many as come.
  bool refuses_slews(const std::string& reason) {
    const double before = test::counter_of(status_, reason);
    for (int i = 0; i < 3; ++i) {
      ols_msg::slew_t slew{};
      slew.schema_version = ols_msg::slew_t::SCHEMA_VERSION;
      slew.utime = slew.effect_utime = clock_utime_us();
      slew.boot_id = 8;
      slew.sequence = ++slews_;
      slew.station = "alfa";
      slew.lease_s = 0.5;
      bus_.publish(station_channel(kSlewChannel, "alfa"), slew);
      time_.pass(0.1);
    }
    time_.pass(1.5);  // until the status that counts
    return test::counter_of(status_, reason) == before + 3.0;
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
  bool is_forgiven(const std::string& words) {
    return time_.pass(test::kPatience_s, [&] { return !says(words); });
  }

  static constexpr const char* kUnknown = "stop: state before the restart is unknown";
  const std::filesystem::path state_ = folder_ / "state";
  std::int64_t slews_ = 0;
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
  EXPECT_FALSE(says("stop: "));
}

TEST_F(EmergencyStop, AFolderThatWasTakenAwayIsNoLeaveToMove) {
  set(true);
  EXPECT_TRUE(comes_to(Status::STATE_EMERGENCY));
  set(false);
  EXPECT_TRUE(is_said(kNotRearmed));
  // At once, because the station writes in it.
  std::filesystem::rename(state_, state_.string() + "-away");
  restart();
  EXPECT_TRUE(comes_to(Status::STATE_STOPPED));
  EXPECT_TRUE(says(kUnknown + (" (" + state_.string() + " is missing)")));
  EXPECT_TRUE(refuses_slews("refused_precedence"));
  EXPECT_TRUE(is_said("stop: state cannot be saved: "));
  EXPECT_FALSE(std::filesystem::exists(state_));
  std::filesystem::create_directory(state_);
  restart();  // no operator has acted: it is still unknown
  EXPECT_TRUE(comes_to(Status::STATE_STOPPED));
  EXPECT_TRUE(says(kUnknown));
  EXPECT_TRUE(give(Command::COMMAND_RELEASE));
  EXPECT_TRUE(comes_to(Status::STATE_IDLE));
  EXPECT_TRUE(is_forgiven(kUnknown));
}

// A stop may have been pressed. PersistedStationStateTest has every file in every condition.
TEST_F(EmergencyStop, WhatIsDamagedNeedsAHandAtTheStation) {
  std::ofstream(state_ / "alfa.hold") << "holiday\n";
  std::filesystem::remove(state_ / "alfa.doubt");
  std::filesystem::create_directory(state_ / "alfa.doubt");
  restart();
  EXPECT_TRUE(comes_to(Status::STATE_EMERGENCY));
  EXPECT_TRUE(says(kUnknown));
  EXPECT_TRUE(says("ptu: reference before the restart is unknown"));
  EXPECT_TRUE(refuses_slews("refused_emergency"));
  EXPECT_FALSE(give(Command::COMMAND_REARM));
  std::raise(SIGUSR1);
  EXPECT_TRUE(comes_to(Status::STATE_STOPPED));
  EXPECT_EQ(test::counter_of(status_, "refused_rearm_needs_a_hand"), 1.0);
  EXPECT_TRUE(give(Command::COMMAND_RELEASE));
  EXPECT_TRUE(comes_to(Status::STATE_IDLE));
  EXPECT_TRUE(is_forgiven(kUnknown));
}

// It turns by itself, so a stop must hold it, and only a person lets it go on.
class WatchingProcess : public test::StationInSimulatedTime {
 protected:
  WatchingProcess()
      : StationInSimulatedTime(with_stop_input(), [](StationSettings& settings) {
          settings.station.watch.middle = AzimuthElevation{radians(80.0), radians(3.0)};
          settings.station.watch.size_rad.x() = radians(40.0);
        }) {}
  static sim::Scenario with_stop_input() {
    sim::Scenario s = scenario();
    s.gpio.on = true;
    return s;
  }
  bool turns() {
    const double from_rad = station_->angles().pan_rad;
    return time_.pass(test::kPatience_s, [&] {
      return std::abs(station_->angles().pan_rad - from_rad) > radians(2.0);
    });
  }
};

TEST_F(WatchingProcess, AStopHoldsItAndAReleaseLetsItGoOn) {
  EXPECT_TRUE(turns());
  EXPECT_TRUE(status_.state == Status::STATE_IDLE);
  EXPECT_TRUE(give(Command::COMMAND_STOP));
  time_.pass(1.0);
  EXPECT_FALSE(turns());
  EXPECT_TRUE(give(Command::COMMAND_RELEASE));
  EXPECT_TRUE(turns());
  sim::StationFaults pressed;
  pressed.stop_pressed = true;
  station_->set_faults(pressed);
  time_.pass(1.0);
  EXPECT_FALSE(turns());
}

}  // namespace
}  // namespace ols::station
