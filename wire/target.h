// Reads a target, in one way for all programs.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/bus/bus_inbox.h"
#include "ols_msg/target_t.hpp"
#include "wire/object_class.h"

namespace ols::wire {

// A target of the site's estimator; nothing if the message is not one. Its texts are made safe for
// a terminal.
std::optional<ols_msg::target_t> heard_target(const BusMessage& message);

// Whether there is an object, at a place on or near the earth.
bool has_position(const ols_msg::target_t& target);
// [m/s] east, north, up at the target; NaN where it is not estimated.
Eigen::Vector3d velocity_enu(const ols_msg::target_t& target);

// A latitude, a longitude and a height that can be drawn; [deg] WGS84, [m].
bool is_place(double latitude_deg, double longitude_deg, double height_m);

// "tentative", "confirmed", "coasted", "dropped".
const char* track_name(std::int8_t state);
// "ok", "too-few-rays", ..
const char* solution_name(std::int8_t solution);

}  // namespace ols::wire
