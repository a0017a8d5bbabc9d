// Estimates the target's motion as one station sees it, in PTU angles, with a constant-velocity
// Kalman filter for each axis. The result is the servo's feed-forward. It also predicts the target
// while it is not seen for a short time. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols::station {

class AngularTrack {
 public:
  struct Config {
    // Square root of the spectral density of the white acceleration [rad/s^2/sqrt(Hz)].
    double acceleration_sd_rad_s2 = 0.15;
    double initial_rate_sd_rad_s = 0.3;
    double measurement_sd_floor_rad = 2e-5;
  };
  struct State {
    double time_s = 0.0;
    PanTilt angles;
    PanTilt rate;  // [rad/s]
  };

  explicit AngularTrack(const Config& config) : config_(config) {}

  // `angles`: the PTU angles that would put the target on the optical axis; `sd_rad`: their
  // 1-sigma. An update that is not later than the last one is ignored.
  void update(double time_s, const PanTilt& angles, double sd_rad);
  void clear() { state_.reset(); }

  // The state at the last update; nullopt before the first.
  std::optional<State> state() const { return state_; }

  // The state extrapolated to an instant.
  std::optional<PanTilt> at(double time_s) const;

 private:
  struct Axis {
    double angle = 0.0, rate = 0.0;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  };
  void update_axis(Axis& axis, double dt, double measured, double sd_rad) const;

  Config config_;
  std::optional<State> state_;
  Axis pan_, tilt_;
};

}  // namespace ols::station
