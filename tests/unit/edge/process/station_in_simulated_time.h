// A station's whole process in simulated time, and who commands it over the bus.
#pragma once

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/process/clocks.h"
#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "sim/processes/simulated_station.h"
#include "sim/scenario/station_files.h"
#include "tests/unit/temporary_folder.h"
#include "wire/station_status.h"

namespace ols::station::test {

using Command = ols_msg::ptu_command_t;
inline constexpr const char* kBus = "memq://station";
inline constexpr double kHoming_s = 120.0, kPatience_s = 20.0;

class StationInSimulatedTime : public testing::Test {
 protected:
  explicit StationInSimulatedTime(
      const sim::Scenario& scenario,
      const std::function<void(StationSettings&)>& change = [](StationSettings&) {})
      : time_(1'700'000'000'000'000), world_(scenario, 5), bus_(kBus) {
    sim::write_station_files(world_, {kBus, folder_.path(), folder_ / "state"}, folder_.path());
    StationSettings settings = load_station_settings(folder_ / "alfa.toml");
    settings.video.address.clear();
    settings.host.silence_s = 1e9;  // it reads this host, in this host's time
    change(settings);
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
  bool says(const std::string& words) const {
    return std::ranges::any_of(status_.alarm,
                               [&](const auto& alarm) { return alarm.find(words) != alarm.npos; });
  }
  bool is_said(const std::string& words) {
    return time_.pass(kHoming_s, [&] { return says(words); });
  }

  // Whether it is done.
  bool give(std::int8_t command, double pan_rad = 0.0) {
    ++sequence_;
    return send(command, pan_rad);
  }
  // The same under the last order's number again.
  bool send(std::int8_t command, double pan_rad = 0.0) {
    Command message{};
    message.utime = clock_utime_us();
    message.schema_version = Command::SCHEMA_VERSION;
    message.boot_id = 7;
    message.sequence = sequence_;
    message.station = "alfa";
    message.lease_s = 1.0;
    message.command = command;
    message.pan_rad = pan_rad;
    message.tilt_rad = tilt_rad_;
    reply_.reset();
    bus_.publish(station_channel(kPtuChannel, "alfa"), message);
    EXPECT_TRUE(time_.pass(kPatience_s, [this] { return reply_.has_value(); }));
    return reply_ && reply_->accepted;
  }

  void restart() {
    const auto boot = status_.boot_id;
    station_->restart();
    EXPECT_TRUE(time_.pass(kPatience_s, [&] { return status_.boot_id != boot; }));
  }

  const std::string ok_ = wire::device_name(ols_msg::station_status_t::DEVICE_OK);
  TemporaryFolder folder_;
  sim::SimulatedTime time_;
  const sim::World world_;
  LcmBus bus_;
  ols_msg::station_status_t status_{};
  std::optional<ols_msg::command_reply_t> reply_;
  std::int64_t sequence_ = 0;
  double tilt_rad_ = 0.0;  // of orders to point
  std::optional<sim::SimulatedStation> station_;
};

}  // namespace ols::station::test
