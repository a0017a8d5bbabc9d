// A reading: what an input reports about one object, or the reason why the report is not used.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ols::cues {

// A value is NaN or nullopt if the source does not state it.
struct Report {
  std::string name;           // the source's permanent name for the object
  std::string label;          // name for people
  std::int64_t utime_us = 0;  // UTC of the position
  std::int64_t stale_us = 0;  // when the data become invalid, as the source states; 0: not stated
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double height_m = 0.0;  // above the ellipsoid, unless it is a pressure altitude
  bool is_pressure_height = false;
  std::optional<double> horizontal_sd_m, vertical_sd_m;
  std::optional<std::array<double, 3>> velocity_enu_m_s;
  std::optional<double> velocity_sd_m_s;
};

// Why data are not used; to_string() is part of the counter's name.
enum class Refusal {
  kMalformed,
  kNotFinite,
  kOutOfRange,
  kPole,
  kNoHeight,
  kStale,
  kFuture,
  kOwn,        // an object that an ols-export has sent
  kOtherType,  // the object's type is not wanted
  kOutOfArea,
  kTooMany,
  kCount,  // not a reason: the number of reasons
};
const char* to_string(Refusal refusal);

struct Refused {
  Refusal why = Refusal::kMalformed;
  std::string what;  // the name of the object, or what is wrong with its data
};

using Reading = std::variant<Report, Refused>;
using Readings = std::vector<Reading>;

}  // namespace ols::cues
