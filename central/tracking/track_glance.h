// A compact copy of a track's data for a quick check. Checking whole tracks would be slow: many of
// them do not fit into the processor's cache. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "central/tracking/track.h"

namespace ols::fusion {

struct TrackGlance {
  std::int64_t utime_us = 0;
  Eigen::Vector3d p_ecef, v_ecef;
  double position_sd_m = 0.0, velocity_sd_m_s = 0.0;

  // Whether the track may be in the bearing's direction (ECEF), if the direction has an error of up
  // to off_rad. The bound is generous.
  bool may_see(const BearingMeasurement& measurement, const Eigen::Vector3d& direction_ecef,
               double off_rad) const;
};
// The largest likely error of a direction [rad], from all its stated errors. It does not depend on
// the track.
double may_be_off_rad(const LineOfSight& sight);
TrackGlance summarise_track(const Track& track);

}  // namespace ols::fusion
