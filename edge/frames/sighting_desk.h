// Chooses the bearings that are published together with their raw pixel and counts: the two around
// each whole second of UTC. Several stations' sightings can then be interpolated to the same
// instants. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edge/frames/frame_service.h"
#include "edge/station/station_types.h"

namespace ols::station {

struct Sighting {
  Bearing bearing;
  std::int64_t utime_us = 0;  // mid-exposure
  ExposedCounts counts;
};

class SightingDesk {
 public:
  // In time order. Returns the sightings to be published now.
  std::vector<Sighting> take(const Bearing& bearing, std::int64_t utime_us,
                             const FrameService& unit);

 private:
  std::optional<Sighting> last_;
};

}  // namespace ols::station
