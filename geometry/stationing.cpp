#include "geometry/stationing.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>

#include "geometry/angles.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The pose's six angles, then the position: east, north, up.
constexpr int kUnknowns = 9;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using UnknownsMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Jacobian = Eigen::Matrix<double, 2, kUnknowns>;

StationGeometry changed(const StationGeometry& station, const Unknowns& by) {
  StationGeometry result = station;
  ChainParameters& chain = result.chain;
  chain.heading_rad += by[0];
  chain.tilt_x_rad += by[1];
  chain.tilt_y_rad += by[2];
  chain.mount_z_rad += by[3];
  chain.mount_x_rad += by[4];
  chain.mount_y_rad += by[5];
  const Vector3d shift_enu = by.tail<3>();
  if (!shift_enu.isZero(0.0)) {
    result.position = geodetic_from_ecef(LocalFrame(station.position).to_ecef(shift_enu));
  }
  return result;
}

// One deviation of each unknown: what z = 1 is worth. Nothing is known of the heading, whose unit
// is free.
Unknowns scales(const CalibrationSd& sd) {
  Unknowns s;
  s << 1e-3, sd.tilt_rad, sd.tilt_rad, sd.mount_rad, sd.mount_roll_rad, sd.mount_rad, sd.position_m,
      sd.position_m, sd.position_m;
  return s;
}

struct Lines {
  Vector3d measured_enu, landmark_enu;  // unit; in GROUND
  double distance_m = 0.0;
};

Lines lines(const StationGeometry& station, const LandmarkSighting& sighting) {
  const auto ray_cam = unproject(station.camera, sighting.pixel);
  if (!ray_cam) throw std::invalid_argument("the pixel is outside of the lens model");
  const Eigen::Isometry3d camera = enu_from_camera(station.chain, sighting.angles);
  const Vector3d to_landmark =
      LocalFrame(station.position).to_enu(sighting.landmark_ecef) - camera.translation();
  return {camera.linear() * *ray_cam, to_landmark.normalized(), to_landmark.norm()};
}

// How far the measured line is from the landmark's [rad], on the tangent plane of the latter.
Vector2d residual(const StationGeometry& station, const LandmarkSighting& sighting) {
  const Lines l = lines(station, sighting);
  return tangent_basis(azimuth_elevation_from_enu(l.landmark_enu)).transpose() * l.measured_enu;
}

double deviation_rad(const StationGeometry& station, const LandmarkSighting& s) {
  const double pixel_rad = s.pixel_sd_px / station.camera.fx_px;
  const double landmark_rad = s.landmark_sd_m / lines(station, s).distance_m;
  return Vector3d(pixel_rad, s.angles_sd_rad, landmark_rad).norm();
}

void check(const StationGeometry& station, std::span<const LandmarkSighting> sightings) {
  constexpr double kLeastDistance_m = 1.0;
  if (sightings.empty()) throw std::invalid_argument("stationing: no landmark was sighted");
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const LandmarkSighting& s = sightings[i];
    const auto refuse = [i](const char* why) {
      throw std::invalid_argument("stationing: sighting " + std::to_string(i + 1) + ": " + why);
    };
    const Vector3d sds(s.landmark_sd_m, s.pixel_sd_px, s.angles_sd_rad);
    if (!s.landmark_ecef.allFinite() || !s.pixel.allFinite() || !sds.allFinite() ||
        !std::isfinite(s.angles.pan_rad) || !std::isfinite(s.angles.tilt_rad)) {
      refuse("not a finite number");
    }
    if (sds.minCoeff() < 0.0 || sds.tail<2>().isZero(0.0)) refuse("a deviation must be positive");
    if (!unproject(station.camera, s.pixel)) refuse("the pixel is outside of the lens model");
    if (lines(station, s).distance_m < kLeastDistance_m) refuse("the landmark is at the station");
  }
}

// A first heading: the mean turn from the measured azimuths to the landmarks'.
double first_heading(const StationGeometry& rough, std::span<const LandmarkSighting> sightings) {
  std::complex<double> sum = 0.0;
  for (const LandmarkSighting& sighting : sightings) {
    const Lines l = lines(rough, sighting);
    const double turn_rad = azimuth_elevation_from_enu(l.landmark_enu).azimuth_rad -
                            azimuth_elevation_from_enu(l.measured_enu).azimuth_rad;
    sum += std::polar(1.0, turn_rad);
  }
  return wrap_two_pi(rough.chain.heading_rad + std::arg(sum));
}

// Of the residual by the scaled unknowns, by central differences.
Jacobian jacobian(const StationGeometry& station, const LandmarkSighting& sighting,
                  const Unknowns& scale) {
  constexpr double kStep = 1e-2;
  Jacobian J = Jacobian::Zero();
  for (int k = 0; k < kUnknowns; ++k) {
    if (scale[k] == 0.0) continue;
    const Unknowns step = kStep * scale[k] * Unknowns::Unit(k);
    J.col(k) =
        (residual(changed(station, step), sighting) - residual(changed(station, -step), sighting)) /
        (2.0 * kStep);
  }
  return J;
}

struct Normal {
  UnknownsMatrix information;
  Unknowns gradient;
};

Normal normal_equations(const StationGeometry& station, std::span<const LandmarkSighting> sightings,
                        const Unknowns& scale, const Unknowns& z) {
  Unknowns prior = Unknowns::Ones();
  prior[0] = 0.0;
  Normal n{prior.asDiagonal(), prior.cwiseProduct(z)};
  for (const LandmarkSighting& sighting : sightings) {
    const double weight = std::pow(deviation_rad(station, sighting), -2);
    const Jacobian J = jacobian(station, sighting, scale);
    n.information += weight * J.transpose() * J;
    n.gradient += weight * J.transpose() * residual(station, sighting);
  }
  return n;
}

// (cross-elevation, elevation) covariance of the optical axis at these angles.
Eigen::Matrix2d axis_covariance(const StationGeometry& station, const PanTilt& angles,
                                const PoseCovariance& covariance) {
  constexpr double kStep = 1e-6;
  const auto axis = [&](const Unknowns& by) -> Vector3d {
    return enu_from_camera(changed(station, by).chain, angles).linear().col(2);
  };
  const auto basis = tangent_basis(azimuth_elevation_from_enu(axis(Unknowns::Zero())));
  Eigen::Matrix<double, 2, 6> J;
  for (int k = 0; k < 6; ++k) {
    const Unknowns step = kStep * Unknowns::Unit(k);
    J.col(k) = basis.transpose() * (axis(step) - axis(-step)) / (2.0 * kStep);
  }
  return J * covariance * J.transpose();
}

// The heading's and the tilts' deviations that geometry/sight.h must be told so that no line of
// sight up to `highest_rad` is stated better than it is.
void cover(StationGeometry& station, const PoseCovariance& covariance, double highest_rad) {
  constexpr int kAzimuths = 24, kElevations = 2;  // elevations on each side of the horizon
  std::vector<std::pair<double, Eigen::Matrix2d>> seen;
  for (int e = -kElevations; e <= kElevations; ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      const double elevation_rad = highest_rad * e / kElevations;
      const auto angles = aim_along(station, {2.0 * kPi * a / kAzimuths, elevation_rad});
      if (!angles) continue;
      seen.emplace_back(elevation_rad, axis_covariance(station, *angles, covariance));
    }
  }
  double tilt = 0.0, heading = 0.0;
  for (const auto& [elevation_rad, C] : seen) tilt = std::max(C(1, 1), tilt);
  for (const auto& [elevation_rad, C] : seen) {
    const double by_tilt = tilt * std::pow(std::sin(elevation_rad), 2);
    heading = std::max(heading, (C(0, 0) - by_tilt) / std::pow(std::cos(elevation_rad), 2));
  }
  station.sd.heading_rad = std::sqrt(heading);
  station.sd.tilt_rad = std::sqrt(tilt);
  station.sd.mount_rad = 0.0;
}

void check_heading(const Stationing& result) {
  const double worst_rad = std::max(result.station.sd.heading_rad, result.station.sd.tilt_rad);
  if (!result.covariance.allFinite() || !(worst_rad > 0.0 && worst_rad < radians(10.0))) {
    throw std::invalid_argument(
        "stationing: the landmarks leave the heading unknown; they are too near, or too high");
  }
}

}  // namespace

Stationing station_by_landmarks(const StationGeometry& rough,
                                std::span<const LandmarkSighting> sightings, double highest_rad) {
  constexpr int kIterations = 10;
  if (!std::isfinite(highest_rad)) {
    throw std::invalid_argument("stationing: the highest elevation is not a finite number");
  }
  check(rough, sightings);
  const Unknowns scale = scales(rough.sd);
  Unknowns z = Unknowns::Zero();
  z[0] = wrap_pi(first_heading(rough, sightings) - rough.chain.heading_rad) / scale[0];
  for (int i = 0; i < kIterations; ++i) {
    const Normal n = normal_equations(changed(rough, scale.cwiseProduct(z)), sightings, scale, z);
    z -= n.information.ldlt().solve(n.gradient);
  }
  const StationGeometry best = changed(rough, scale.cwiseProduct(z));
  const UnknownsMatrix spread = normal_equations(best, sightings, scale, z).information.inverse();

  Stationing result;
  result.station = best;
  result.station.position = rough.position;
  result.station.chain.heading_rad = wrap_two_pi(best.chain.heading_rad);
  result.covariance = (scale.asDiagonal() * spread * scale.asDiagonal()).topLeftCorner<6, 6>();
  result.station.sd.mount_roll_rad = std::sqrt(result.covariance(4, 4));
  cover(result.station, result.covariance, highest_rad);
  check_heading(result);
  for (const LandmarkSighting& s : sightings) {
    result.residuals.push_back(residual(best, s) / deviation_rad(best, s));
  }
  return result;
}

}  // namespace ols
