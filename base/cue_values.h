// What a cue from outside may say at all: judged where it is read, and again by the fusion, which
// hears of it over the bus. Pure.
#pragma once

#include <array>

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
  kOutOfRange,  // a latitude, a speed, a deviation that cannot be
  kPole,        // there east and north mean nothing
};
CueFault fault_of(const CueValues& cue);

}  // namespace ols
