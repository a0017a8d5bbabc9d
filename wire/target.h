// Reads a target, for all programs.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/bus/bus_inbox.h"
#include "ols_msg/target_t.hpp"
#include "wire/object_class.h"

namespace ols::wire {

// nullopt if the message is not a target of the site's fusion. The target's texts are made safe for
// a terminal (base/text/plain_text.h).
std::optional<ols_msg::target_t> decode_target(const BusMessage& message);

// Whether the message states the position of an object, and the position is on or near the earth.
bool has_position(const ols_msg::target_t& target);
// The velocity [m/s] in east, north, up at the target; NaN if it is not estimated.
Eigen::Vector3d velocity_enu(const ols_msg::target_t& target);

// Whether latitude, longitude [deg, WGS84] and height [m] are finite and in a range that can be
// drawn.
bool is_place(double latitude_deg, double longitude_deg, double height_m);

// "tentative", "confirmed", "coasted", "dropped".
const char* track_name(std::int8_t state);
// For example "ok", "too-few-rays".
const char* solution_name(std::int8_t solution);

}  // namespace ols::wire
