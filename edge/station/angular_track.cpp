#include "edge/station/angular_track.h"

#include <algorithm>

#include "geometry/angles.h"

namespace ols::station {

void AngularTrack::update(double time_s, const PanTilt& angles, double sd_rad) {
  const double sd = std::max(sd_rad, config_.measurement_sd_floor_rad);
  if (!state_) {
    Eigen::Matrix2d start = Eigen::Matrix2d::Zero();
    start(0, 0) = sd * sd;
    start(1, 1) = config_.initial_rate_sd_rad_s * config_.initial_rate_sd_rad_s;
    pan_ = {angles.pan_rad, 0.0, start};
    tilt_ = {angles.tilt_rad, 0.0, start};
  } else {
    const double dt = time_s - state_->time_s;
    if (!(dt > 0.0)) return;
    update_axis(pan_, dt, angles.pan_rad, sd);
    update_axis(tilt_, dt, angles.tilt_rad, sd);
  }
  state_ = State{time_s, {pan_.angle, tilt_.angle}, {pan_.rate, tilt_.rate}};
}

void AngularTrack::update_axis(Axis& axis, double dt, double measured, double sd_rad) const {
  const double q = config_.acceleration_sd_rad_s2 * config_.acceleration_sd_rad_s2;
  Eigen::Matrix2d F;
  F << 1.0, dt, 0.0, 1.0;
  Eigen::Matrix2d Q;  // white acceleration, integrated over dt
  Q << dt * dt * dt / 3.0, dt * dt / 2.0, dt * dt / 2.0, dt;
  const double predicted = axis.angle + dt * axis.rate;
  const Eigen::Matrix2d P = F * axis.covariance * F.transpose() + q * Q;
  const Eigen::Vector2d gain = P.col(0) / (P(0, 0) + sd_rad * sd_rad);
  const double innovation = wrap_pi(measured - predicted);
  axis.angle = predicted + gain(0) * innovation;
  axis.rate += gain(1) * innovation;
  axis.covariance = P - gain * P.row(0);
}

std::optional<PanTilt> AngularTrack::at(double time_s) const {
  if (!state_) return std::nullopt;
  const double dt = time_s - state_->time_s;
  return PanTilt{state_->angles.pan_rad + dt * state_->rate.pan_rad,
                 state_->angles.tilt_rad + dt * state_->rate.tilt_rad};
}

}  // namespace ols::station
