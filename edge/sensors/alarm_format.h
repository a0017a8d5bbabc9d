// Formats values with their units for the texts of alarms. Pure.
#pragma once

#include <string>

namespace ols::sensors {

std::string format_length(double length_m);  // "0.31 m", "103 m", "12 km"
std::string format_time(double time_s);      // "12 s", "6 min", "5 h"
std::string format_angle(double angle_rad);  // "0.31 deg"

}  // namespace ols::sensors
