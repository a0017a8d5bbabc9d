// Checks the values of a cue from outside: once when the cue is read, and again in the fusion when
// it arrives over the bus. Pure.
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
  kOutOfRange,  // an impossible latitude, speed or deviation
  kPole,        // east and north are undefined there
};
CueFault fault_of(const CueValues& cue);

// The number of the target that an order names in place of a cue; nullopt if the order names a cue.
// The name of a cue (INPUT.NAME) is never a number alone.
std::optional<std::int64_t> target_named(const std::string& name);

}  // namespace ols
