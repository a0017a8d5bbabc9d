// Reads a target; all programs use these functions.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/bus/bus_inbox.h"
#include "ols_msg/target_t.hpp"
#include "wire/object_class.h"

namespace ols::wire {

// A target of the site's estimator; nullopt if the message is not one. The texts in it are made
// safe for a terminal.
std::optional<ols_msg::target_t> decode_target(const BusMessage& message);

// Whether the target is an object with a position on or near the earth.
bool has_position(const ols_msg::target_t& target);
// The velocity [m/s]: east, north, up at the target; NaN if it is not estimated.
Eigen::Vector3d velocity_enu(const ols_msg::target_t& target);

// Whether latitude, longitude [deg, WGS84] and height [m] are a place that can be drawn.
bool is_place(double latitude_deg, double longitude_deg, double height_m);

// "tentative", "confirmed", "coasted", "dropped".
const char* track_name(std::int8_t state);
// For example "ok", "too-few-rays".
const char* solution_name(std::int8_t solution);

}  // namespace ols::wire
