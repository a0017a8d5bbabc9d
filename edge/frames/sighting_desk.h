// Chooses the bearings that are published together with their raw pixel and encoder counts: the
// last bearing before each whole second of UTC, and the first one after it. The sightings of
// several stations can then be interpolated to the same times. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edge/frames/exposed_counts.h"
#include "edge/frames/pointing_model.h"
#include "edge/station/station_types.h"

namespace ols::station {

struct Sighting {
  Bearing bearing;
  std::int64_t utime_us = 0;  // mid-exposure
  ExposedCounts counts;
};

class SightingDesk {
 public:
  // Takes bearings in the order of their times. Returns the sightings that are to be published now.
  std::vector<Sighting> take(const Bearing& bearing, std::int64_t utime_us,
                             const PointingModel& unit);

 private:
  std::optional<Sighting> last_;
};

}  // namespace ols::station
