// Which of a station's bearings are told with the counts and the pixel that they are made of: the
// two around each whole second of UTC, so that whoever reads them knows several stations' sightings
// at the same instants. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edge/frame_service.h"
#include "edge/station_types.h"

namespace ols::station {

struct Sighting {
  Bearing bearing;
  std::int64_t utime_us = 0;  // mid-exposure
  ExposedCounts counts;
};

class SightingDesk {
 public:
  // In time order; what is to be told now.
  std::vector<Sighting> take(const Bearing& bearing, std::int64_t utime_us,
                             const FrameService& unit);

 private:
  std::optional<Sighting> last_;
};

}  // namespace ols::station
