// One station's exposures of the last second, to detect duplicates and floods (too many bearings
// per second). Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

class RecentExposures {
 public:
  // Whether a bearing is a duplicate of a stored one: both are of the same exposure, and they have
  // the same object or the same direction.
  bool has(const BearingMeasurement& measurement) const;
  // Advances the time to this bearing, and forgets exposures that are more than a second older.
  // Must also be called for refused bearings: otherwise a station would be refused for ever after
  // one flood.
  void go_on_to(std::int64_t utime_us);
  void add(const BearingMeasurement& measurement);
  void clear() { exposures_.clear(); }
  // Whether the last second contains more bearings than this rate allows.
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
