// Numbers in alarms, as a person would say them. Pure.
#pragma once

#include <string>

namespace ols {

std::string length_in_words(double length_m);  // "0.31 m", "103 m", "12 km"
std::string time_in_words(double time_s);      // "12 s", "6 min", "5 h"
std::string angle_in_words(double angle_rad);  // "0.31 deg"

}  // namespace ols
