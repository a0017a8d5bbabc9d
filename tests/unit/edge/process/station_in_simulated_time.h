// A station's whole process in simulated time, and an operator who commands it over the bus.
#pragma once

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <functional>
#include <memory>
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

// A counter in the status of a station or a fusion; 0: the status has no counter of this name.
double counter_of(const auto& status, const std::string& name) {
  const auto found = std::ranges::find(status.counter_name, name);
  const auto at = static_cast<std::size_t>(found - status.counter_name.begin());
  return found == status.counter_name.end() ? 0.0 : status.counter_value.at(at);
}
bool alarms_of(const auto& status, const std::string& words) {
  return std::ranges::any_of(status.alarm, [&](const std::string& alarm) {
    return alarm.find(words) != std::string::npos;
  });
}

// A site whose stations have detectors. A drone passes 75 m above the site's middle twice in each
// period.
inline sim::Scenario passing_drone(double period_s, const Eigen::Vector3d& amplitude_enu_m) {
  sim::Scenario s = sim::load_scenario(std::string(OLS_SCENARIOS) + "/faults.toml");
  s.detector_on = true;
  s.inclinometer.on = s.gnss.on = s.gpio.on = false;
  auto path = std::make_shared<sim::Lissajous>();
  path->centre_enu = {0.0, 0.0, 75.0};
  path->amplitude_m = amplitude_enu_m;
  path->period_s.setConstant(period_s);
  s.targets.resize(1);
  s.targets.front().trajectory = path;
  return s;
}

class StationInSimulatedTime : public testing::Test {
 protected:
  explicit StationInSimulatedTime(
      const sim::Scenario& scenario,
      const std::function<void(StationSettings&)>& change = [](StationSettings&) {})
      : time_(kStart_us), world_(scenario, 5), bus_(kBus) {
    sim::write_station_files(world_, {kBus, folder_.path(), folder_ / "state"}, folder_.path());
    StationSettings settings = settings_of("alfa");
    change(settings);
    spdlog::set_level(spdlog::level::off);
    bus_.subscribe(station_channel(kStatusChannel, "alfa"), [this](const BusMessage& message) {
      if (auto heard = wire::decode_status(message)) status_ = std::move(*heard);
    });
    bus_.subscribe(station_channel(kReplyChannel, ".*"), [this](const BusMessage& message) {
      ols_msg::command_reply_t reply{};
      if (decode_of_schema(message, reply) && reply.order_sequence == sequence_) reply_ = reply;
    });
    station_.emplace(world_, 0, settings, time_);
    time_.at_each_step([this](double) { bus_.handle(0); });
    EXPECT_TRUE(is_trusted());
  }

  // Points a station to where the drone passes.
  bool look_at_middle(std::size_t station) {
    const auto& tripod = world_.stations()[station];
    const auto angles = aim_at(tripod.nominal, world_.site().to_ecef({0.0, 0.0, 75.0}));
    if (!angles) return false;
    tilt_rad_ = angles->tilt_rad;
    return give(Command::COMMAND_POINT, angles->pan_rad, world_.scenario().stations[station].id);
  }

  static sim::Scenario scenario() {
    sim::Scenario s = sim::load_scenario(std::string(OLS_SCENARIOS) + "/calibration.toml");
    s.frame_rate_hz = 1.0;
    s.inclinometer.on = s.gnss.on = false;
    return s;
  }

  StationSettings settings_of(const std::string& station) const {
    StationSettings settings = load_station_settings(folder_ / (station + ".toml"));
    settings.video.address.clear();
    settings.host.silence_s = 1e9;  // the monitor measures the real host, in real time
    return settings;
  }

  bool is_trusted() {
    return time_.pass(kHoming_s, [this] { return wire::device_state(status_, "ptu") == ok_; });
  }
  bool says(const std::string& words) const { return alarms_of(status_, words); }
  bool is_said(const std::string& words) {
    return time_.pass(kHoming_s, [&] { return says(words); });
  }

  // Sends a new order; returns whether it was accepted.
  bool give(std::int8_t command, double pan_rad = 0.0, const std::string& station = "alfa") {
    ++sequence_;
    return send(command, pan_rad, station);
  }
  // The same, but with the sequence number of the last order.
  bool send(std::int8_t command, double pan_rad = 0.0, const std::string& station = "alfa") {
    Command message{};
    message.utime = clock_utime_us();
    message.schema_version = Command::SCHEMA_VERSION;
    message.boot_id = 7;
    message.sequence = sequence_;
    message.station = station;
    message.lease_s = 1.0;
    message.command = command;
    message.pan_rad = pan_rad;
    message.tilt_rad = tilt_rad_;
    reply_.reset();
    bus_.publish(station_channel(kPtuChannel, station), message);
    EXPECT_TRUE(time_.pass(kPatience_s, [this] { return reply_.has_value(); }));
    return reply_ && reply_->accepted;
  }

  void restart() {
    const auto boot = status_.boot_id;
    station_->restart();
    EXPECT_TRUE(time_.pass(kPatience_s, [&] { return status_.boot_id != boot; }));
  }

  static constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
  const std::string ok_ = wire::device_name(ols_msg::station_status_t::DEVICE_OK);
  TemporaryFolder folder_;
  sim::SimulatedTime time_;
  const sim::World world_;
  LcmBus bus_;
  ols_msg::station_status_t status_{};
  std::optional<ols_msg::command_reply_t> reply_;
  std::int64_t sequence_ = 0;
  double tilt_rad_ = 0.0;  // of the orders to point
  std::optional<sim::SimulatedStation> station_;
};

}  // namespace ols::station::test
