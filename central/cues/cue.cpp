#include "central/cues/cue.h"

#include <cmath>

#include "central/measurement/time_span.h"

namespace ols::fusion {

// At constant velocity: the source reports again within seconds.
KinematicState CueAim::at(std::int64_t utime_us) const {
  const double dt_s = seconds(utime_us - cue.state_us);
  const Eigen::Matrix3d R = R_ecef_enu(cue.place);
  const Eigen::Vector3d velocity = R * cue.velocity_enu_m_s;
  const double grown_m =
      std::hypot(cue.velocity_sd_m_s * dt_s, 0.5 * acceleration_sd_m_s2 * dt_s * dt_s);
  const double horizontal_m = std::hypot(cue.horizontal_sd_m, grown_m);
  const Eigen::Vector3d sd_m(horizontal_m, horizontal_m, std::hypot(cue.vertical_sd_m, grown_m));
  KinematicState state;
  state.utime_us = utime_us;
  state.mean.head<3>() = ecef_from_geodetic(cue.place) + dt_s * velocity;
  state.mean.segment<3>(3) = velocity;
  state.covariance.topLeftCorner<3, 3>() = R * sd_m.cwiseAbs2().asDiagonal() * R.transpose();
  const double velocity_sd_m_s = std::hypot(cue.velocity_sd_m_s, acceleration_sd_m_s2 * dt_s);
  state.covariance.block<3, 3>(3, 3).diagonal().setConstant(velocity_sd_m_s * velocity_sd_m_s);
  return state;
}

}  // namespace ols::fusion
