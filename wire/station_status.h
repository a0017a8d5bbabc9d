// Reads a station's status, for all programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "base/bus/bus_inbox.h"
#include "ols_msg/station_status_t.hpp"

namespace ols::wire {

// The maximum number of stations that a program keeps. It limits the memory that forged statuses
// with invented names can use.
inline constexpr std::size_t kMostStationsHeard = 2000;

// Returns nullopt if the message is not a status, or does not name the station of its channel. The
// status's texts are made safe for a terminal (base/text/plain_text.h).
std::optional<ols_msg::station_status_t> decode_status(const BusMessage& message);

// The value of a counter in a status; 0 if it is missing.
double counter(const ols_msg::station_status_t& status, const std::string& name);

const char* state_name(std::int8_t state);
// Whether the state (station_status_t::STATE_*) means stopped, by a person or by the emergency
// stop.
bool is_stopped(std::int8_t state);
const char* device_name(std::int8_t device);
// The state of the device with this name; "-" if the station has no such device.
const char* device_state(const ols_msg::station_status_t& status, const std::string& name);
// The version of the station's program, cut to one line; "-" if the status does not state it.
std::string software(const ols_msg::station_status_t& status);
// Where the pose comes from: "surveyed", "sensor", "unknown".
const char* source_name(std::int8_t source);
// "synchronised", "unsynchronised", "unknown".
const char* clock_name(std::int8_t state);
// "none", "in use", "refused", "doubted".
const char* calibration_name(std::int8_t state);

}  // namespace ols::wire
