#include "sim/network/command_flood.h"

#include <limits>
#include <utility>

#include "base/bus/channel_names.h"
#include "base/bus/message_stamp.h"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/slew_t.hpp"

namespace ols::sim {
namespace {

constexpr std::int64_t kAhead_us = 450'000;    // within the permitted clock difference
constexpr std::int64_t kLong_us = 60'000'000;  // beyond any lease, and any clock difference
constexpr std::int64_t kOldSender = 4711;      // whose sequences are used up
constexpr double kLease_s = 1.0;
constexpr double kBeyondTilt_rad = 1.5;  // no unit reaches this

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> data(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(data.data(), 0, static_cast<int>(data.size()));
  return data;
}

}  // namespace

double swing_goal_rad(std::int64_t utime_us) {
  return utime_us / kSwing_us % 2 == 0 ? kSwing_rad : -kSwing_rad;
}

CommandFlood::CommandFlood(std::string station, std::uint64_t seed)
    : station_(std::move(station)), random_(seed) {}

int CommandFlood::below(int limit) {
  return static_cast<int>(random_() % static_cast<std::uint64_t>(limit));
}

// A fresh command from an unknown sender.
template <class Message>
void CommandFlood::address(Message& message, std::int64_t utime_us) {
  const auto boot_id = static_cast<std::int64_t>(random_() >> 1U);
  stamp_message(message, utime_us, boot_id, 1 + below(1000));
  message.station = station_;
  message.lease_s = kLease_s;
}

// Makes the command one that every station must refuse; false: it was left valid.
template <class Message>
bool CommandFlood::spoil(Message& message, int how) {
  switch (how) {
    case 0:
      message.utime -= kLong_us;
      return true;
    case 1:
      message.utime += kLong_us;
      return true;
    case 2:  // replayed: a minute old, with the sequence and stamp of then
      message.boot_id = kOldSender;
      message.sequence = below(1000);
      message.utime -= kLong_us;
      return true;
    case 3:
      message.station = "nobody";
      return true;
    case 4:
      message.schema_version = 99;
      return true;
    case 5:
      message.lease_s = std::numeric_limits<double>::quiet_NaN();
      return true;
    default:
      return false;
  }
}

Packet CommandFlood::ptu(std::int64_t utime_us) {
  ols_msg::ptu_command_t message{};
  address(message, utime_us);
  const int how = below(9);
  if (spoil(message, how)) {
    message.command = below(2) == 0 ? ols_msg::ptu_command_t::COMMAND_POINT
                                    : ols_msg::ptu_command_t::COMMAND_RELEASE;
  } else if (how == 8) {
    message.command = ols_msg::ptu_command_t::COMMAND_POINT;
    message.pan_rad = swing_goal_rad(utime_us);
  } else {  // fresh by every check of the gate; refused for its direction
    message.utime += how == 6 ? kAhead_us : 0;
    message.command = ols_msg::ptu_command_t::COMMAND_POINT;
    message.tilt_rad = kBeyondTilt_rad;
  }
  return {station_channel(kPtuChannel, station_), encoded(message)};
}

Packet CommandFlood::slew(std::int64_t utime_us) {
  ols_msg::slew_t message{};
  address(message, utime_us);
  if (!spoil(message, below(8))) message.sequence = std::numeric_limits<std::int64_t>::max();
  message.lease_s *= 0.5;
  message.effect_utime = message.utime + 100'000;
  message.azimuth_rad = below(6);
  message.direction_sd_rad = 1e-3;
  return {station_channel(kSlewChannel, station_), encoded(message)};
}

Packet CommandFlood::designate(std::int64_t utime_us) {
  ols_msg::designate_t message{};
  address(message, utime_us);
  if (!spoil(message, below(8))) message.utime += kAhead_us;
  // Far outside any image: a designation that could be obeyed would end a stop.
  message.x_px = message.y_px = 1e6;
  message.width_px = message.height_px = 10.0;
  return {station_channel(kDesignateChannel, station_), encoded(message)};
}

Packet CommandFlood::next(std::int64_t utime_us) {
  const int kind = below(8);
  Packet packet = kind < 4 ? ptu(utime_us) : kind < 6 ? slew(utime_us) : designate(utime_us);
  if (below(8) == 0)
    packet.data.resize(packet.data.size() - 1 - static_cast<std::size_t>(below(8)));
  return packet;
}

}  // namespace ols::sim
