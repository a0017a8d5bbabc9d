// The fusion's input: one bearing of one station.
#pragma once

#include <cstdint>
#include <string>

#include "geometry/direction.h"

namespace ols::fusion {

// How a station states that its UTC is synchronised.
enum class StationClock { kUnknown, kSynchronised, kUnsynchronised };

struct BearingMeasurement {
  std::string station;
  std::int64_t utime_us = 0;  // UTC since 1970 at mid-exposure, by the station's clock
  LineOfSight sight;
  double belief = 1.0;
  double clock_sd_s = 0.0;  // 1-sigma of utime_us, systematic
  StationClock clock = StationClock::kUnknown;
  std::int64_t boot_id = 0;   // of the station's process: each numbers its track_ids from the start
  std::int64_t track_id = 0;  // identifies one followed object of that station
  std::int64_t calibration_id = 0;  // a new id: new systematic errors
};

}  // namespace ols::fusion
