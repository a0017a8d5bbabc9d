// What an input says of one object, or why that is not used.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ols::cues {

// NaN or nothing: the source does not say.
struct Report {
  std::string name;           // as its source calls it, stable
  std::string label;          // for people
  std::int64_t utime_us = 0;  // UTC of the place
  std::int64_t stale_us = 0;  // until when its source stands by it; 0: it does not say
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double height_m = 0.0;  // above the ellipsoid, unless it is the pressure's
  bool is_pressure_height = false;
  std::optional<double> horizontal_sd_m, vertical_sd_m;
  std::optional<std::array<double, 3>> velocity_enu_m_s;
  std::optional<double> velocity_sd_m_s;
};

// to_string() names its counter.
enum class Refusal {
  kMalformed,
  kNotFinite,
  kOutOfRange,
  kPole,
  kNoHeight,
  kStale,
  kFuture,
  kOwn,        // what ols-export has sent
  kOtherType,  // not of those that are wanted
  kOutOfArea,
  kTooMany,
  kCount,  // not a reason: how many there are
};
const char* to_string(Refusal refusal);

struct Refused {
  Refusal why = Refusal::kMalformed;
  std::string what;  // which object, or what is wrong with it
};

using Reading = std::variant<Report, Refused>;
using Readings = std::vector<Reading>;

}  // namespace ols::cues
