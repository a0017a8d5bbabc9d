// A station on a bus within the process: publishes its state and stores the commands that it
// receives.
#pragma once

#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/process/clocks.h"
#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/frame_part_t.hpp"
#include "ols_msg/frame_request_t.hpp"
#include "ols_msg/procedure_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::calibration::test {

class BusStation {
 public:
  BusStation() {
    bus.subscribe(station_channel(kPtuChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::ptu_command_t command;
      command.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
      commands.push_back(command.command);
      if (on_command) on_command();
      answer(command);
    });
  }

  void say(std::int8_t state) {
    ols_msg::station_status_t status{};
    status.utime = 1;
    status.schema_version = ols_msg::station_status_t::SCHEMA_VERSION;
    status.station = "alfa";
    status.boot_id = 1;
    status.sequence = ++sequence_;
    status.state = state;
    status.pan_rad = pan_rad;
    bus.publish(station_channel(kStatusChannel, "alfa"), status);
  }

  void answer(const ols_msg::ptu_command_t& command) {
    ols_msg::command_reply_t reply{};
    reply.utime = 1;
    reply.schema_version = ols_msg::command_reply_t::SCHEMA_VERSION;
    reply.station = "alfa";
    reply.boot_id = 1;
    reply.sequence = ++sequence_;
    reply.order_boot_id = command.boot_id;
    reply.order_sequence = command.sequence;
    reply.reason = refusal;
    reply.accepted = refusal.empty() ? 1 : 0;
    bus.publish(station_channel(kReplyChannel, "alfa"), reply);
  }

  virtual ~BusStation() = default;
  BusStation(const BusStation&) = delete;
  BusStation& operator=(const BusStation&) = delete;

  LcmBus bus{"memq://"};
  std::vector<std::int8_t> commands;
  std::function<void()> on_command;
  double pan_rad = 0.0;  // in the status
  std::string refusal;   // reason with which it refuses all commands; empty: accepts them

 private:
  std::int64_t sequence_ = 0;
};

// A station whose unit arrives immediately where it is sent, and whose camera answers requests. It
// publishes its state whenever the procedure publishes its own.
class MovingStation : public BusStation {
 public:
  MovingStation() {
    bus.subscribe(station_channel(kPtuChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::ptu_command_t command;
      command.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
      if (command.command == ols_msg::ptu_command_t::COMMAND_POINT) {
        go(command.pan_rad, command.tilt_rad);
      }
      say(state);
    });
    bus.subscribe(station_channel(kProcedureChannel, "alfa"),
                  [this](const BusMessage&) { say(state); });
    bus.subscribe(station_channel(kFrameRequestChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::frame_request_t request;
      request.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
      if (on_request) on_request();
      if (state == ols_msg::station_status_t::STATE_MANUAL) send(request);
      say(state);
    });
  }

  std::int8_t state = ols_msg::station_status_t::STATE_MANUAL;
  std::function<void()> on_request;
  std::vector<std::pair<double, double>> ways;  // the unit's motions, each in pan and tilt [rad]
  bool knows_sides = true;
  int pictures = 0;

 private:
  void go(double pan_rad, double tilt_rad) {
    const double pan_way = pan_rad - pan_rad_, tilt_way = tilt_rad - tilt_rad_;
    if (pan_way == 0.0 && tilt_way == 0.0) return;
    ways.emplace_back(pan_way, tilt_way);
    const auto side = [](double way, int before) {
      return way == 0.0 ? before : way > 0.0 ? 1 : -1;
    };
    pan_side_ = side(pan_way, pan_side_);
    tilt_side_ = side(tilt_way, tilt_side_);
    pan_rad_ = pan_rad;
    tilt_rad_ = tilt_rad;
  }
  void send(const ols_msg::frame_request_t& request) {
    constexpr double kCount_rad = 2.0 * 3.14159265358979323846 / 112000.0;
    ols_msg::frame_part_t part{};
    part.utime = clock_utime_us();
    part.schema_version = ols_msg::frame_part_t::SCHEMA_VERSION;
    part.station = "alfa";
    part.request_boot_id = request.boot_id;
    part.request_sequence = request.sequence;
    part.pan_counts = pan_rad_ / kCount_rad;
    part.tilt_counts = tilt_rad_ / kCount_rad;
    part.approach_pan = static_cast<std::int8_t>(knows_sides ? pan_side_ : 0);
    part.approach_tilt = static_cast<std::int8_t>(knows_sides ? tilt_side_ : 0);
    part.pan_count_rad = part.tilt_count_rad = kCount_rad;
    part.encoding = request.encoding;
    part.parts = 1;
    cv::imencode(".png", cv::Mat(12, 16, CV_8U, cv::Scalar(++pictures)), part.data);
    part.bytes = static_cast<std::int32_t>(part.data.size());
    bus.publish(station_channel(kFrameChannel, "alfa"), part);
  }

  double pan_rad_ = 0.0, tilt_rad_ = 0.0;
  int pan_side_ = 0, tilt_side_ = 0;
};

}  // namespace ols::calibration::test
