// What the fusion takes in: one bearing of one station.
#pragma once

#include <cstdint>
#include <string>

#include "geometry/direction.h"

namespace ols {

struct Sighting {
  std::string station;
  std::int64_t utime_us = 0;  // UTC since 1970 at mid-exposure, by the station's clock
  SightLine sight;
  double belief = 1.0;
  double clock_sd_s = 0.0;    // 1-sigma of utime_us, stays
  std::int64_t track_id = 0;  // one id is one followed object of that station
};

}  // namespace ols
