// What a station makes of its unit: of a cut line, and of the unit's reference over its starts. Its
// whole process in simulated time.
#include "tests/unit/edge/process/station_in_simulated_time.h"

namespace ols::station {
namespace {

using test::Command;
constexpr const char* kGears = "ptu: no reference";

class StationStarts : public test::StationInSimulatedTime {
 protected:
  StationStarts() : StationInSimulatedTime(scenario()) {}

  void set_faults(bool power_cycle, bool line_gone, bool line_cut = false) {
    sim::StationFaults faults;
    faults.ptu.power_cycle = power_cycle;
    faults.ptu.homes_then = false;
    faults.ptu.line_gone = line_gone;
    faults.ptu.line_cut = line_cut;
    station_->set_faults(faults);
  }
};

using StationLine = StationStarts;

TEST_F(StationLine, ACutOneIsSaidHaltsTheUnitAndHeals) {
  const auto has_come_to = [this](double pan_rad) {
    return time_.pass(test::kPatience_s, [&] {
      const double true_rad = station_->angles().pan_rad;
      return std::abs(true_rad - pan_rad) < 0.01 && std::abs(true_rad - status_.pan_rad) < 1e-3;
    });
  };
  EXPECT_TRUE(give(Command::COMMAND_POINT, 0.2));
  EXPECT_TRUE(has_come_to(0.2));
  EXPECT_TRUE(give(Command::COMMAND_POINT, 2.0));
  EXPECT_TRUE(time_.pass(test::kPatience_s, [this] { return station_->angles().pan_rad > 0.4; }));
  set_faults(false, false, true);
  EXPECT_TRUE(is_said("ptu: halted, no "));
  EXPECT_NE(wire::device_state(status_, "ptu"), ok_);
  time_.pass(1.0);
  const double there_rad = station_->angles().pan_rad;
  EXPECT_LT(there_rad, 1.5);
  time_.pass(5.0);
  EXPECT_EQ(station_->angles().pan_rad, there_rad);
  set_faults(false, false);
  EXPECT_TRUE(is_trusted());
  EXPECT_TRUE(give(Command::COMMAND_POINT, -0.2));
  EXPECT_TRUE(has_come_to(-0.2));
}

TEST_F(StationStarts, LostGearsOutliveEachAndNobodyVouchesForThem) {
  set_faults(true, false);
  EXPECT_TRUE(is_said(kGears));
  EXPECT_FALSE(give(Command::COMMAND_REFERENCE_OK));
  restart();
  EXPECT_TRUE(is_said(kGears));
  EXPECT_FALSE(give(Command::COMMAND_REFERENCE_OK));
  set_faults(false, true);
  EXPECT_TRUE(is_said("no serial port"));
  restart();
  set_faults(false, false);
  EXPECT_TRUE(is_said(kGears));
  EXPECT_FALSE(give(Command::COMMAND_REFERENCE_OK));
  EXPECT_TRUE(give(Command::COMMAND_HOME));
  EXPECT_TRUE(is_trusted());
}

TEST_F(StationStarts, ADoubtOutlivesThemUntilAPersonVouches) {
  EXPECT_TRUE(give(Command::COMMAND_HOME));
  EXPECT_TRUE(is_said("homing"));
  EXPECT_TRUE(give(Command::COMMAND_STOP));
  EXPECT_TRUE(is_said("halted, homing was interrupted"));
  restart();
  EXPECT_TRUE(is_said("halted, its reference was in doubt already before this start"));
  EXPECT_NE(wire::device_state(status_, "ptu"), ok_);
  EXPECT_TRUE(give(Command::COMMAND_REFERENCE_OK));
  EXPECT_TRUE(is_trusted());
  restart();
  EXPECT_TRUE(is_trusted());
}

// Whoever gave a stop and heard nothing sends it again: by then the station may have restarted.
TEST_F(StationStarts, AStopIsAnsweredAndConfirmedBeforeAndAfterThem) {
  EXPECT_TRUE(give(Command::COMMAND_STOP));
  ASSERT_TRUE(reply_);
  EXPECT_TRUE(wire::is_stopped(reply_->state));
  restart();
  EXPECT_TRUE(wire::is_stopped(status_.state));
  EXPECT_TRUE(send(Command::COMMAND_STOP));
  ASSERT_TRUE(reply_);
  EXPECT_TRUE(wire::is_stopped(reply_->state));
}

TEST_F(StationStarts, CommandsThatAreRefusedAgainAndAgainAreAnAlarmOfItsStatus) {
  Command recorded{};
  recorded.utime = clock_utime_us();
  recorded.schema_version = Command::SCHEMA_VERSION;
  recorded.boot_id = 7;
  recorded.station = "alfa";
  recorded.command = Command::COMMAND_POINT;
  recorded.lease_s = 1.0;
  for (int again = 0; again < 5; ++again) {
    bus_.publish(station_channel(kPtuChannel, "alfa"), recorded);
  }
  EXPECT_TRUE(is_said("PTU commands refused in 10 s"));
}

}  // namespace
}  // namespace ols::station
