// Writes valid LCM messages as seeds: fuzz_seeds FOLDER makes FOLDER/messages, FOLDER/exporter,
// FOLDER/fault_plan, FOLDER/fusion_messages, FOLDER/station_commands and FOLDER/video_request.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ols_msg/bearing_t.hpp"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/cue_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/lens_command_t.hpp"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/preview_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "ols_msg/sighting_t.hpp"
#include "ols_msg/sim_fault_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"
#include "ols_msg/video_request_t.hpp"
#include "ols_msg/video_stream_request_t.hpp"

namespace {

constexpr std::int64_t kUtime = 1'700'000'000'000'000;

template <class Message>
std::string encoded(const Message& message) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return {bytes.begin(), bytes.end()};
}

template <class Message>
Message from_station() {
  Message message{};
  message.utime = kUtime;
  message.schema_version = Message::SCHEMA_VERSION;
  message.station = "a";
  message.boot_id = 1;
  message.sequence = 1;
  return message;
}

template <class Message>
Message command() {
  auto message = from_station<Message>();
  message.lease_s = 1.0;
  return message;
}

ols_msg::bearing_t bearing(const char* station, double azimuth_rad, double north_m) {
  auto message = from_station<ols_msg::bearing_t>();
  message.station = station;
  message.belief = 0.9;
  message.camera_ecef_m[0] = 6378137.0;
  message.camera_ecef_m[2] = north_m;
  message.azimuth_rad = azimuth_rad;
  message.elevation_rad = 0.1;
  message.covariance_white_rad2[0] = message.covariance_white_rad2[2] = 1e-8;
  message.covariance_systematic_rad2[0] = message.covariance_systematic_rad2[2] = 1e-8;
  message.clock_error_s = 1e-3;
  return message;
}

ols_msg::station_status_t status() {
  auto message = from_station<ols_msg::station_status_t>();
  message.latitude_deg = 49.0;
  message.longitude_deg = 16.0;
  message.camera_ecef_m[0] = 6.37e6;
  message.devices = 1;
  message.device_name = {"ptu"};
  message.device_state = {2};
  message.device_text = {"well"};
  message.device_age_s = {0.1};
  message.counters = 1;
  message.counter_name = {"frames"};
  message.counter_value = {1.0};
  return message;
}

ols_msg::slew_t slew() {
  auto message = command<ols_msg::slew_t>();
  message.effect_utime = kUtime + 100'000;
  message.azimuth_rad = 1.5;
  message.elevation_rad = 0.1;
  message.direction_sd_rad = 1e-3;
  return message;
}

ols_msg::occlusion_t occlusion() {
  auto message = command<ols_msg::occlusion_t>();
  message.holds_s = 4.0;
  message.exit_utime = kUtime + 3'000'000;
  message.azimuth_rad = 1.5;
  message.elevation_rad = 0.1;
  return message;
}

ols_msg::skyline_t skyline() {
  auto message = from_station<ols_msg::skyline_t>();
  message.begun_utime = kUtime;
  message.camera_ecef_m[0] = 6.37e6;
  message.sector = 1;
  message.columns = 1;
  message.column = {100};
  message.elevation_rad = {0.1F};
  message.sd_rad = {0.01F};
  message.hides_from_m = {100.0F};
  message.disagrees = {1};
  return message;
}

ols_msg::designate_t designation() {
  auto message = command<ols_msg::designate_t>();
  message.x_px = message.y_px = 100.0;
  message.width_px = message.height_px = 24.0;
  return message;
}

ols_msg::fusion_status_t fusion_status() {
  ols_msg::fusion_status_t message{};
  message.schema_version = ols_msg::fusion_status_t::SCHEMA_VERSION;
  message.counters = 1;
  message.counter_name = {"targets"};
  message.counter_value = {3.0};
  message.alarms = 1;
  message.alarm = {"another fusion is on the bus: stop one of them"};
  return message;
}

ols_msg::cue_t cue() {
  ols_msg::cue_t message{};
  message.schema_version = ols_msg::cue_t::SCHEMA_VERSION;
  message.utime = message.state_utime = kUtime;
  message.id = "a";
  message.horizontal_sd_m = message.vertical_sd_m = 5.0;
  message.velocity_sd_m_s = 1.0;
  return message;
}

ols_msg::cue_order_t cue_order() {
  ols_msg::cue_order_t message{};
  message.schema_version = ols_msg::cue_order_t::SCHEMA_VERSION;
  message.cue = "a";
  message.allow = 1;
  message.lease_s = 2.0;
  return message;
}

ols_msg::target_t target() {
  ols_msg::target_t message{};
  message.schema_version = ols_msg::target_t::SCHEMA_VERSION;
  message.stations = 1;
  message.station = {"a"};
  message.used = {1};
  message.weight = {1.0};
  message.age_s = {0.0};
  return message;
}

ols_msg::sim_fault_t fault(const char* kind, double duration_s, double value) {
  ols_msg::sim_fault_t message{};
  message.utime = kUtime;
  message.kind = kind;
  message.station = "a";
  message.duration_s = duration_s;
  message.value = value;
  return message;
}

void write(const std::filesystem::path& file, const std::string& content) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
}

// A datagram of `fuzz_fusion_messages` (kind and station, length, bytes) or of `fuzz_fault_plan`
// (how long after the one before).
std::string framed(char kind, const std::string& bytes) {
  return {kind + std::string(1, static_cast<char>(bytes.size() & 255U)) + bytes};
}

// The same of `fuzz_exporter`, whose lengths have two bytes.
std::string framed_long(char kind, const std::string& bytes) {
  return {kind + std::string(1, static_cast<char>(bytes.size() >> 8U)) +
          std::string(1, static_cast<char>(bytes.size() & 255U)) + bytes};
}

// Datagrams of `fuzz_datagrams`: as it is on the wire; or the payload of one of its channels.
std::string whole(const std::string& bytes) {
  const std::size_t length = 2 * bytes.size();
  return {static_cast<char>(length & 255U) + std::string(1, static_cast<char>(length >> 8U)) +
          bytes};
}

std::string of_channel(char channel, const std::string& payload) {
  const std::size_t length = 2 * payload.size() + 1;
  return {static_cast<char>(length & 255U) + std::string(1, static_cast<char>(length >> 8U)) +
          std::string(1, channel) + payload};
}

void write_video_requests(const std::filesystem::path& folder) {
  ols_msg::video_request_t request{};
  request.schema_version = ols_msg::video_request_t::SCHEMA_VERSION;
  request.max_width_px = 32;
  request.quality = 60;
  write(folder / "video_request" / "whole", encoded(request));
  ols_msg::video_stream_request_t stream{};
  stream.schema_version = ols_msg::video_stream_request_t::SCHEMA_VERSION;
  stream.max_width_px = 32;
  stream.quality = 60;
  write(folder / "video_request" / "stream", encoded(stream));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const std::vector<std::string> all = {encoded(bearing("a", 0.5, 0.0)),
                                        encoded(designation()),
                                        encoded(fusion_status()),
                                        encoded(from_station<ols_msg::preview_t>()),

                                        encoded(command<ols_msg::ptu_command_t>()),
                                        encoded(command<ols_msg::record_t>()),
                                        encoded(ols_msg::sim_fault_t{}),
                                        encoded(slew()),
                                        encoded(status()),
                                        encoded(target()),
                                        encoded(command<ols_msg::lens_command_t>()),
                                        encoded(cue()),
                                        encoded(cue_order()),
                                        encoded(from_station<ols_msg::sighting_t>())};
  for (std::size_t kind = 0; kind < all.size(); ++kind) {
    write(folder / "messages" / std::to_string(kind), static_cast<char>(kind) + all[kind]);
  }
  constexpr char kOcclusion = 16;
  write(folder / "messages" / "occlusion", kOcclusion + encoded(occlusion()));
  write(folder / "messages" / "skyline", static_cast<char>(kOcclusion + 1) + encoded(skyline()));
  const std::string from_a = encoded(bearing("a", 0.5, 0.0));
  const std::string from_b = encoded(bearing("b", 2.0, 500.0));
  write(folder / "fusion_messages" / "two", framed('\0', from_a) + framed('\2', from_b));
  write(folder / "fusion_messages" / "status", framed('\1', encoded(status())));
  write(folder / "fusion_messages" / "skyline",
        framed('\1', encoded(status())) + framed('\100', encoded(skyline())));
  write(folder / "fusion_messages" / "cue",
        framed('\1', encoded(status())) + framed('\20', encoded(cue())) +
            framed('\40', encoded(cue_order())) + framed('\20', encoded(cue())));
  write(folder / "exporter" / "site", std::string(1, '\0') + framed_long('\0', encoded(status())) +
                                          framed_long('\1', encoded(fusion_status())));
  write(folder / "fault_plan" / "two", framed('\12', encoded(fault("ptu-garbled", 5.0, 0.01))) +
                                           framed('\12', encoded(fault("all", 0.0, 0.0))));
  // Of the two datagrams that end a program with liblcm 1.3.1, and of a message cut in the middle.
  const std::string first = std::string("LC03\0\0\0\7\0\0\0\x64\0\0\0\0\0\0\0\3", 20) +
                            "OLS_STATUS_x" + std::string(1, '\0') + "AAAA";
  const std::string second =
      std::string("LC03\0\0\0\7\0\0\0\x64\xff\xff\xff\0\0\1\0\3", 20) + std::string(272, 'B');
  write(folder / "datagrams" / "fragments", whole(first) + whole(second));
  write(folder / "datagrams" / "cut", whole("LC02abcdOLS_STATUS_a"));
  write(folder / "datagrams" / "messages",
        of_channel(0, encoded(slew())) + of_channel(1, encoded(command<ols_msg::ptu_command_t>())) +
            of_channel(4, encoded(status())) + of_channel(5, from_a));
  int kind = 0;
  for (const auto& bytes :
       {encoded(slew()), encoded(command<ols_msg::ptu_command_t>()), encoded(designation()),
        encoded(command<ols_msg::record_t>()), encoded(occlusion())}) {
    write(folder / "station_commands" / std::to_string(kind),
          framed(static_cast<char>(kind), bytes));
    ++kind;
  }
  write_video_requests(folder);
  return 0;
}
