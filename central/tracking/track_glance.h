// What a quick look at a track needs, side by side: a whole track fills the cache by itself. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "central/tracking/track.h"

namespace ols::fusion {

struct TrackGlance {
  std::int64_t utime_us = 0;
  Eigen::Vector3d p_ecef, v_ecef;
  double position_sd_m = 0.0, velocity_sd_m_s = 0.0;

  // Whether it may be in this direction (the bearing's, ECEF): generously.
  bool may_see(const BearingMeasurement& sighting, const Eigen::Vector3d& direction_ecef) const;
};
TrackGlance summarise_track(const Track& track);

}  // namespace ols::fusion
