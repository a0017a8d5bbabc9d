#include "dev/estimators/posterior_bound.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>

#include "central/measurement/ray.h"

namespace ols::bench {

std::vector<double> posterior_bound(const WorldConfig& config, const Path& path,
                                    const std::vector<fusion::BearingMeasurement>& bearings,
                                    double disturbance, double position_sd_m,
                                    double velocity_sd_m_s) {
  const auto stations = static_cast<Eigen::Index>(config.stations_enu.size());
  // Of each station its rotation; then of each its place.
  const Eigen::Index rotations = 6, places = 6 + 3 * stations, n = 6 + 6 * stations;
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(n, n);
  P.diagonal().head<3>().setConstant(position_sd_m * position_sd_m);
  P.diagonal().segment<3>(3).setConstant(velocity_sd_m_s * velocity_sd_m_s);
  const Eigen::Array3d variance = rotation_sd_rad(config).array().square().max(1e-24);
  const Eigen::VectorXd stays = variance.matrix().replicate(stations, 1);
  P.diagonal().segment(rotations, 3 * stations) = stays;
  P.diagonal().tail(3 * stations).setConstant(config.place_sd_m * config.place_sd_m);
  std::vector<double> bound;
  std::int64_t last_us = bearings.front().utime_us;
  for (const fusion::BearingMeasurement& measurement : bearings) {
    const double dt = 1e-6 * static_cast<double>(measurement.utime_us - last_us);
    last_us = measurement.utime_us;
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(n, n);
    F.block<3, 3>(0, 3).diagonal().setConstant(dt);
    const double decay = std::exp(-dt / config.bias_time_s);
    F.diagonal().segment(rotations, 3 * stations).setConstant(decay);
    P = F * P * F.transpose();
    P.diagonal().segment(rotations, 3 * stations) += (1.0 - decay * decay) * stays;
    const double s = disturbance * disturbance;
    P.diagonal().head<3>().array() += s * dt * dt * dt / 3.0;
    P.diagonal().segment<3>(3).array() += s * dt;
    P.block<3, 3>(0, 3).diagonal().array() += s * dt * dt / 2.0;
    P.block<3, 3>(3, 0).diagonal().array() += s * dt * dt / 2.0;
    const double time_s = 1e-6 * static_cast<double>(measurement.utime_us - kStartUs);
    const Eigen::Vector3d line =
        site().to_ecef(at(path, time_s).p_enu) - measurement.sight.origin_ecef;
    const fusion::RayFrame frame = fusion::ray_frame(measurement.sight);
    const auto station = std::atoi(measurement.station.c_str() + 1);
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, n);
    H.leftCols<3>() = frame.tangent.transpose() / line.norm();
    H.middleCols<3>(rotations + 3 * station) =
        shift_by_rotation(tangent_basis(measurement.sight.direction));
    H.middleCols<3>(places + 3 * station) =
        -tangent_basis(measurement.sight.direction).transpose() / line.norm();
    const Eigen::Matrix2d S = H * P * H.transpose() + measurement.sight.covariance_white;
    P -= P * H.transpose() * S.inverse() * H * P;
    bound.push_back(P.topLeftCorner<3, 3>().trace());
  }
  return bound;
}

}  // namespace ols::bench
