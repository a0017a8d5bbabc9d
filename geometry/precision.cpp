#include "geometry/precision.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "geometry/direction.h"

namespace ols {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

double squared(double value) { return value * value; }

double elevation_of(const LocalFrame& station, const Vector3d& p_ecef) {
  return azimuth_elevation_from_enu(station.to_enu(p_ecef)).elevation_rad;
}

}  // namespace

Eigen::Matrix<double, 2, 3> bearing_jacobian(const LocalFrame& station, const Vector3d& p_ecef) {
  const Vector3d p_enu = station.to_enu(p_ecef);
  const auto basis = tangent_basis(azimuth_elevation_from_enu(p_enu));
  return basis.transpose() * station.R_ecef_enu().transpose() / p_enu.norm();
}

Matrix3d bearing_information(const BearingPrecision& bearing, const Vector3d& p_ecef) {
  const auto H = bearing_jacobian(bearing.station, p_ecef);
  return H.transpose() * bearing.covariance_rad2.inverse() * H;
}

std::optional<Matrix3d> bound_from_information(const Matrix3d& information) {
  constexpr double kDetermined = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(information);
  const Vector3d values = solver.eigenvalues();  // in growing order
  if (!(values.x() > kDetermined * values.z())) return std::nullopt;
  const Matrix3d& axes = solver.eigenvectors();
  return axes * values.cwiseInverse().asDiagonal() * axes.transpose();
}

std::optional<Matrix3d> cramer_rao_bound(std::span<const BearingPrecision> bearings,
                                         const Vector3d& p_ecef) {
  Matrix3d information = Matrix3d::Zero();
  for (const BearingPrecision& bearing : bearings) {
    information += bearing_information(bearing, p_ecef);
  }
  return bound_from_information(information);
}

Matrix2d source_covariance(const PlannedStation& station, ErrorSource source,
                           const PlannedTarget& target, double exposures) {
  const CalibrationSd& sd = station.calibration;
  switch (source) {
    case ErrorSource::kWhite:
      return squared(station.white_rad) / exposures * Matrix2d::Identity();
    case ErrorSource::kHeading: {
      const double cosine = std::cos(elevation_of(station.place, target.p_ecef));
      return Eigen::Vector2d(squared(sd.heading_rad * cosine), 0.0).asDiagonal();
    }
    case ErrorSource::kTilt: {
      // About the horizontal axis across the sight line, and about the one along it.
      const double sine = std::sin(elevation_of(station.place, target.p_ecef));
      return Eigen::Vector2d(squared(sd.tilt_rad * sine), squared(sd.tilt_rad)).asDiagonal();
    }
    case ErrorSource::kMounting:
      return squared(sd.mount_rad) * Matrix2d::Identity();
    case ErrorSource::kPosition: {
      const auto H = bearing_jacobian(station.place, target.p_ecef);
      return squared(sd.position_m) * H * H.transpose();
    }
    case ErrorSource::kClock: {
      const auto H = bearing_jacobian(station.place, target.p_ecef);
      return squared(station.clock_sd_s) * H * target.velocity_moment_ecef * H.transpose();
    }
  }
  throw std::invalid_argument("source_covariance: no such source");
}

BearingPrecision bearing_precision(const PlannedStation& station, const PlannedTarget& target,
                                   double exposures) {
  Matrix2d covariance = Matrix2d::Zero();
  for (const ErrorSource source : kErrorSources) {
    covariance += source_covariance(station, source, target, exposures);
  }
  return {station.place, covariance};
}

std::optional<PositionPrecision> position_precision(std::span<const PlannedStation> stations,
                                                    const PlannedTarget& target, double exposures) {
  std::vector<const PlannedStation*> seeing;
  std::vector<BearingPrecision> bearings;
  for (const PlannedStation& station : stations) {
    if (!station.in_sight(target.p_ecef)) continue;
    seeing.push_back(&station);
    bearings.push_back(bearing_precision(station, target, exposures));
  }
  const auto bound = cramer_rao_bound(bearings, target.p_ecef);
  if (!bound) return std::nullopt;
  PositionPrecision precision{*bound, {}};
  precision.parts_ecef.fill(Matrix3d::Zero());
  for (std::size_t i = 0; i < seeing.size(); ++i) {
    // How the efficient estimate moves with this station's direction: C H' R^-1.
    const auto H = bearing_jacobian(seeing[i]->place, target.p_ecef);
    const Eigen::Matrix<double, 3, 2> gain =
        *bound * H.transpose() * bearings[i].covariance_rad2.inverse();
    for (std::size_t k = 0; k < kErrorSources.size(); ++k) {
      precision.parts_ecef.at(k) +=
          gain * source_covariance(*seeing[i], kErrorSources.at(k), target, exposures) *
          gain.transpose();
    }
  }
  return precision;
}

}  // namespace ols
