// Checks the values of a cue from outside. ols-cue does this when it reads a cue; the fusion does
// it again when the cue arrives over the bus. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace ols {

struct CueValues {
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
  std::array<double, 3> velocity_enu_m_s{};
  double velocity_sd_m_s = 0.0;
};

enum class CueFault {
  kNone,
  kNotFinite,
  kOutOfRange,  // an impossible latitude, speed or standard deviation
  kPole,        // east and north are undefined there
};
CueFault fault_of(const CueValues& cue);

// An order on a cue may name a target instead, by its number. Returns this number; nullopt if
// `name` is the name of a cue (INPUT.NAME), which is never a mere number.
std::optional<std::int64_t> target_named(const std::string& name);

}  // namespace ols
