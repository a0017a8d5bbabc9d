// Operators' orders and stations' statuses as messages of the bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/bus_inbox.h"
#include "base/lcm_bus.h"
#include "command/outcome.h"
#include "ols_msg/station_status_t.hpp"

namespace ols::command {

// Limits the memory that forged statuses with invented names can use.
inline constexpr std::size_t kMostStationsHeard = 2000;

// nullopt if it is no status, or not from the station of its channel. Its texts are made safe for a
// terminal (base/plain_text.h).
std::optional<ols_msg::station_status_t> heard_status(const BusMessage& message);

Reply reply_of(const ols_msg::station_status_t& status);

// An order of any sender; nullopt if it is none, or not for the station of its channel.
std::optional<Order> heard_order(const BusMessage& message);

// The value of a counter in a status; 0 if it is missing.
double counter(const ols_msg::station_status_t& status, const std::string& name);

const char* state_name(std::int8_t state);
const char* device_name(std::int8_t device);
// The state of a device; "-" if the station has no such device.
const char* device_state(const ols_msg::station_status_t& status, const std::string& name);
// The version of the station's program, cut to one line; "-" if it is not stated.
std::string software(const ols_msg::station_status_t& status);
// "synchronised", "unsynchronised", "unknown".
const char* clock_name(std::int8_t state);
// "none", "in use", "refused", "doubted".
const char* calibration_name(std::int8_t state);

// A cue from the fusion's status.
struct FusionCue {
  std::string id, label, state;  // "waiting", "searched", "found", "forbidden"
  std::int64_t target_id = 0;
  double age_s = 0.0, latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
};
struct FusionCues {
  std::vector<FusionCue> cues;
  double orders_refused = 0.0;  // a counter
};
// nullopt if it is no fusion status. Its texts are made safe for a terminal.
std::optional<FusionCues> heard_cues(const BusMessage& message);

// An operator's decision on a cue.
struct CueOrder {
  std::string cue;
  bool allow = false;
};

// Sends orders under one boot id, each with its own sequence number.
class OrderSender {
 public:
  explicit OrderSender(std::int64_t boot_id) : boot_id_(boot_id) {}

  // `utime_us`: this host's UTC. False if the network is down.
  bool send(LcmBus& bus, const Order& order, std::int64_t utime_us);
  bool send(LcmBus& bus, const CueOrder& order, std::int64_t utime_us);

 private:
  template <class Message>
  void address(Message& message, const Order& order, std::int64_t utime_us);

  std::int64_t boot_id_;
  std::int64_t sequence_ = 0;
};

}  // namespace ols::command
