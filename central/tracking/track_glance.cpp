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

namespace {

constexpr double kGenerous = 8.0, kLeastRad = 0.02;

}  // namespace

// The largest angle by which a bearing may be off its target.
double may_be_off_rad(const LineOfSight& sight) {
  return kLeastRad + kGenerous * std::sqrt(sight.covariance_white.trace() +
                                           sight.covariance_systematic.trace());
}

bool TrackGlance::may_see(const BearingMeasurement& measurement, const Eigen::Vector3d& d,
                          double off_rad) const {
  const double dt_s = seconds(measurement.utime_us - utime_us);
  const Eigen::Vector3d line = p_ecef + dt_s * v_ecef - measurement.sight.origin_ecef;
  const double depth = d.dot(line);
  if (!(depth > 0.0)) return false;
  const double spread_m = position_sd_m + std::abs(dt_s) * velocity_sd_m_s;
  const double within_m = kGenerous * spread_m + depth * off_rad;
  return (line - depth * d).squaredNorm() < within_m * within_m;
}

}  // namespace ols::fusion
