// Makes logs in the format of lcm-logger, byte by byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"

namespace ols {

inline constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

inline std::string big_endian_bytes(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

inline std::string log_record(std::int64_t utime_us, const std::string& channel,
                              const std::string& payload) {
  return std::string("\xED\xA1\xDA\x01") + big_endian_bytes(1, 8) +
         big_endian_bytes(static_cast<std::uint64_t>(utime_us), 8) +
         big_endian_bytes(channel.size(), 4) + big_endian_bytes(payload.size(), 4) + channel +
         payload;
}

template <class Message>
std::string payload_of(const Message& message) {
  std::string bytes(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

// A status of the station alfa, with this count of stops and, if not empty, an alarm.
inline std::string logged_status(std::int64_t utime_us, double stops = 0.0,
                                 const std::string& alarm = "") {
  ols_msg::station_status_t status{};
  status.schema_version = ols_msg::station_status_t::SCHEMA_VERSION;
  status.station = "alfa";
  status.utime = utime_us;
  status.counters = 1;
  status.counter_name = {"stop_accepted"};
  status.counter_value = {stops};
  status.state = stops > 0.0 ? ols_msg::station_status_t::STATE_STOPPED
                             : ols_msg::station_status_t::STATE_TRACKING;
  if (!alarm.empty()) {
    status.alarms = 1;
    status.alarm = {alarm};
  }
  return log_record(utime_us, "OLS_STATUS_alfa", payload_of(status));
}

inline std::string logged_stop(std::int64_t utime_us) {
  ols_msg::ptu_command_t command{};
  command.schema_version = ols_msg::ptu_command_t::SCHEMA_VERSION;
  command.station = "alfa";
  command.command = ols_msg::ptu_command_t::COMMAND_STOP;
  return log_record(utime_us, "OLS_PTU_alfa", payload_of(command));
}

// The station's answer to the stop.
inline std::string logged_reply(std::int64_t utime_us) {
  ols_msg::command_reply_t reply{};
  reply.schema_version = ols_msg::command_reply_t::SCHEMA_VERSION;
  reply.station = "alfa";
  reply.accepted = 1;
  reply.state = ols_msg::station_status_t::STATE_STOPPED;
  return log_record(utime_us, "OLS_REPLY_alfa", payload_of(reply));
}

// A skyline of the station with one column, which disagrees with the model of the land.
inline std::string logged_skyline(std::int64_t utime_us, std::int16_t column) {
  ols_msg::skyline_t skyline{};
  skyline.schema_version = ols_msg::skyline_t::SCHEMA_VERSION;
  skyline.station = "alfa";
  skyline.begun_utime = kStart_us;
  skyline.columns = 1;
  skyline.column = {column};
  skyline.elevation_rad = skyline.sd_rad = skyline.hides_from_m = {0.5F};
  skyline.disagrees = {1};
  return log_record(utime_us, "OLS_SKYLINE_alfa", payload_of(skyline));
}

inline std::string logged_target(std::int64_t utime_us, double latitude_deg,
                                 bool is_dropped = false,
                                 const std::string& channel = "OLS_TARGET") {
  ols_msg::target_t target{};
  target.schema_version = ols_msg::target_t::SCHEMA_VERSION;
  target.utime = utime_us;
  target.boot_id = 3;
  target.target_id = 7;
  target.latitude_deg = latitude_deg;
  target.position_covariance_enu_m2[0] = target.position_covariance_enu_m2[3] = 1.0;
  target.track_state =
      is_dropped ? ols_msg::target_t::TRACK_DROPPED : ols_msg::target_t::TRACK_CONFIRMED;
  return log_record(utime_us, channel, payload_of(target));
}

// A file that exists as long as this object.
class LogFile {
 public:
  explicit LogFile(const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() /
              ("ols_replay_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + "_" +
               std::to_string(bytes.size()) + ".lcmlog")) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~LogFile() { std::filesystem::remove(path_); }
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace ols
