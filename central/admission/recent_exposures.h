// One station's exposures of the last second: which bearings are duplicates, and how many come.
// Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

class RecentExposures {
 public:
  // Is it the same exposure's bearing of the same object, or in the same direction, again?
  bool has(const BearingMeasurement& sighting) const;
  // Forgets what is a second older than the newest, this one included: a bearing that is refused
  // goes on in time, too, or a flood would lock its station out for good.
  void go_on_to(std::int64_t utime_us);
  void add(const BearingMeasurement& sighting);
  void clear() { exposures_.clear(); }
  // So many bearings in the span that is kept.
  bool is_flood(double flood_hz) const;
  double rate_hz() const { return rate_hz_; }

 private:
  struct Exposure {
    std::int64_t utime_us = 0;
    AzimuthElevation direction;
    std::int64_t track_id = 0;
  };
  std::vector<Exposure> exposures_;  // in order of time
  double rate_hz_ = 0.0;
};

}  // namespace ols::fusion
