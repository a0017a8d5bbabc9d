// What a station knows of its unit's reference over its starts: its whole process in simulated
// time.
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <string>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/process/clocks.h"
#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "sim/processes/simulated_station.h"
#include "sim/scenario/station_files.h"
#include "tests/unit/logger/temporary_folder.h"
#include "wire/station_status.h"

namespace ols::station {
namespace {

using Command = ols_msg::ptu_command_t;
constexpr const char* kBus = "memq://starts";
constexpr const char* kGears = "ptu: no reference";
constexpr double kHoming_s = 120.0, kPatience_s = 20.0;

class StationStarts : public testing::Test {
 protected:
  StationStarts() : time_(1'700'000'000'000'000), world_(scenario(), 5), bus_(kBus) {
    sim::write_station_files(world_, {kBus, folder_.path(), folder_ / "state"}, folder_.path());
    StationSettings settings = load_station_settings(folder_ / "alfa.toml");
    settings.video.address.clear();
    settings.host.silence_s = 1e9;  // it reads this host, in this host's time
    spdlog::set_level(spdlog::level::off);
    bus_.subscribe(station_channel(kStatusChannel, "alfa"), [this](const BusMessage& message) {
      if (auto heard = wire::heard_status(message)) status_ = std::move(*heard);
    });
    bus_.subscribe(station_channel(kReplyChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::command_reply_t reply{};
      if (decode_of_schema(message, reply) && reply.order_sequence == sequence_) reply_ = reply;
    });
    station_.emplace(world_, 0, settings, time_);
    time_.at_each_step([this](double) { bus_.handle(0); });
    EXPECT_TRUE(is_trusted());
  }

  static sim::Scenario scenario() {
    sim::Scenario s = sim::load_scenario(std::string(OLS_SCENARIOS) + "/calibration.toml");
    s.frame_rate_hz = 1.0;
    s.inclinometer.on = s.gnss.on = false;
    return s;
  }

  bool is_trusted() {
    return time_.pass(kHoming_s, [this] { return wire::device_state(status_, "ptu") == ok_; });
  }
  bool is_said(const std::string& words) {
    return time_.pass(kHoming_s, [&] {
      return std::ranges::any_of(
          status_.alarm, [&](const auto& alarm) { return alarm.find(words) != alarm.npos; });
    });
  }

  // Whether it is done.
  bool give(std::int8_t command) {
    ++sequence_;
    return send(command);
  }
  // The same under the last order's number again.
  bool send(std::int8_t command) {
    Command message{};
    message.utime = clock_utime_us();
    message.schema_version = Command::SCHEMA_VERSION;
    message.boot_id = 7;
    message.sequence = sequence_;
    message.station = "alfa";
    message.lease_s = 1.0;
    message.command = command;
    reply_.reset();
    bus_.publish(station_channel(kPtuChannel, "alfa"), message);
    EXPECT_TRUE(time_.pass(kPatience_s, [this] { return reply_.has_value(); }));
    return reply_ && reply_->accepted;
  }

  void set_faults(bool power_cycle, bool line_gone) {
    sim::StationFaults faults;
    faults.ptu.power_cycle = power_cycle;
    faults.ptu.homes_then = false;
    faults.ptu.line_gone = line_gone;
    station_->set_faults(faults);
  }

  void restart() {
    const auto boot = status_.boot_id;
    station_->restart();
    EXPECT_TRUE(time_.pass(kPatience_s, [&] { return status_.boot_id != boot; }));
  }

  const std::string ok_ = wire::device_name(ols_msg::station_status_t::DEVICE_OK);
  logger::TemporaryFolder folder_;
  sim::SimulatedTime time_;
  const sim::World world_;
  LcmBus bus_;
  ols_msg::station_status_t status_{};
  std::optional<ols_msg::command_reply_t> reply_;
  std::int64_t sequence_ = 0;
  std::optional<sim::SimulatedStation> station_;
};

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

}  // namespace
}  // namespace ols::station
