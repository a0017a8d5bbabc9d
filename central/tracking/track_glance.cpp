#include "central/tracking/track_glance.h"

#include <cmath>

#include "central/measurement/time_span.h"

namespace ols::fusion {

TrackGlance summarise_track(const Track& track) {
  const KinematicState& state = track.filter.summary();
  return {state.utime_us, state.mean.head<3>(), state.mean.segment<3>(3),
          std::sqrt(state.covariance.topLeftCorner<3, 3>().trace()),
          std::sqrt(state.covariance.block<3, 3>(3, 3).trace())};
}

// Within this many sigmas of all possible errors.
bool TrackGlance::may_see(const BearingMeasurement& measurement, const Eigen::Vector3d& d) const {
  const double dt_s = seconds(measurement.utime_us - utime_us);
  const Eigen::Vector3d line = p_ecef + dt_s * v_ecef - measurement.sight.origin_ecef;
  const double depth = d.dot(line);
  if (!(depth > 0.0)) return false;
  const double spread_m = position_sd_m + std::abs(dt_s) * velocity_sd_m_s;
  const double angle = std::sqrt(measurement.sight.covariance_white.trace() +
                                 measurement.sight.covariance_systematic.trace());
  constexpr double kGenerous = 8.0, kLeastRad = 0.02;
  return (line - depth * d).norm() < kGenerous * (spread_m + depth * angle) + depth * kLeastRad;
}

}  // namespace ols::fusion
