#include "sim/lockstep/bound.h"

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "geometry/precision.h"

namespace ols::sim {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// An unknown parameter of a station: how it is varied, and its 1-sigma.
struct Unknown {
  std::function<void(StationGeometry&, double)> change;
  double sd;
  double step;
};

std::vector<Unknown> unknowns(const CalibrationSd& sd, double k1_sd) {
  constexpr double kAngle = 1e-5, kLength_m = 1e-2, kK1 = 1e-3;
  std::vector<Unknown> list = {
      {[](auto& g, double d) { g.chain.heading_rad += d; }, sd.heading_rad, kAngle},
      {[](auto& g, double d) { g.chain.tilt_x_rad += d; }, sd.tilt_rad, kAngle},
      {[](auto& g, double d) { g.chain.tilt_y_rad += d; }, sd.tilt_rad, kAngle},
      {[](auto& g, double d) { g.chain.mount_z_rad += d; }, sd.mount_rad, kAngle},
      {[](auto& g, double d) { g.chain.mount_y_rad += d; }, sd.mount_rad, kAngle},
      {[](auto& g, double d) { g.chain.mount_x_rad += d; }, sd.mount_roll_rad, kAngle},
      {[](auto& g, double d) { g.camera.k1 += d; }, k1_sd, kK1}};
  for (int axis = 0; axis < 3; ++axis) {
    list.push_back({[axis](StationGeometry& g, double d) {
                      const Vector3d shift_enu = d * Vector3d::Unit(axis);
                      g.position = geodetic_from_ecef(LocalFrame(g.position).to_ecef(shift_enu));
                    },
                    sd.position_m, kLength_m});
  }
  return list;
}

Vector2d pixel_of(const StationGeometry& g, const PanTilt& angles, const Vector3d& p_ecef) {
  return view(g, angles, p_ecef).value().pixel;
}

// A column of a Jacobian by central differences of a function of one number.
Vector2d slope(double step, const std::function<Vector2d(double)>& pixel) {
  return (pixel(step) - pixel(-step)) / (2.0 * step);
}

Matrix2d outer(const Vector2d& v) { return v * v.transpose(); }

// Covariance of one pixel measurement about the prediction from the position.
Matrix2d pixel_covariance(const World& world, const StationTruth& station, const PanTilt& angles,
                          const TargetTruth& target, const MeasurementNoise& noise, bool is_fixed) {
  const Errors& e = world.scenario().errors;
  const StationGeometry& g = station.truth;
  Matrix2d R = (std::pow(e.designation.stated_sd_px(), 2) +
                noise.white_share * std::pow(noise.pixel_sd_px, 2)) *
               Matrix2d::Identity();
  const double k1_sd = e.distortion.on ? e.distortion.residual_k1_sd : 0.0;
  for (const Unknown& unknown : unknowns(station.nominal.sd, k1_sd)) {
    R += outer(unknown.sd * slope(unknown.step, [&](double d) {
                 StationGeometry changed = g;
                 unknown.change(changed, d);
                 return pixel_of(changed, angles, target.p_ecef);
               }));
  }
  R += outer(station.clock_sd_s * slope(1e-3, [&](double dt) {
               return pixel_of(g, angles, target.p_ecef + dt * target.v_ecef);
             }));
  const double step_rad = radians(world.ptu_unit_config().resolution_arcsec / 3600.0);
  const double encoder_variance = is_fixed ? 0.0 : noise.white_share * step_rad * step_rad / 12.0;
  const Vector2d pan = slope(1e-5, [&](double d) {
    return pixel_of(g, {angles.pan_rad + d, angles.tilt_rad}, target.p_ecef);
  });
  const Vector2d tilt = slope(1e-5, [&](double d) {
    return pixel_of(g, {angles.pan_rad, angles.tilt_rad + d}, target.p_ecef);
  });
  return R + encoder_variance * (outer(pan) + outer(tilt));
}

// The same covariance on the tangent plane of the direction to the target.
BearingPrecision bearing_precision_of(const World& world, const StationTruth& station,
                                      const PanTilt& angles, const TargetTruth& target,
                                      const MeasurementNoise& noise, bool is_fixed) {
  const LocalFrame centre(geodetic_from_ecef(camera_centre_ecef(station.truth, angles)));
  const auto H = bearing_jacobian(centre, target.p_ecef);
  Eigen::Matrix<double, 2, 3> pixel_by_position;
  for (int axis = 0; axis < 3; ++axis) {
    pixel_by_position.col(axis) = slope(1e-2, [&](double d) {
      return pixel_of(station.truth, angles, target.p_ecef + d * Vector3d::Unit(axis));
    });
  }
  const Matrix2d pixel_by_angle = pixel_by_position * H.transpose() * (H * H.transpose()).inverse();
  const Matrix2d angle_by_pixel = pixel_by_angle.inverse();
  const Matrix2d R = pixel_covariance(world, station, angles, target, noise, is_fixed);
  return {centre, angle_by_pixel * R * angle_by_pixel.transpose()};
}

}  // namespace

std::optional<Eigen::Matrix3d> position_bound_enu(const World& world, double time_s,
                                                  const std::vector<std::size_t>& stations,
                                                  const MeasurementNoise& noise) {
  const TargetTruth target = world.target(0, time_s);
  std::vector<BearingPrecision> bearings;
  for (const std::size_t index : stations) {
    const StationTruth& station = world.stations()[index];
    const auto& fixed = world.scenario().stations[index].fixed;
    const auto angles = fixed ? fixed : aim_at(station.truth, target.p_ecef);
    if (!angles || !view(station.truth, *angles, target.p_ecef)) continue;
    bearings.push_back(
        bearing_precision_of(world, station, *angles, target, noise, fixed.has_value()));
  }
  const auto bound = cramer_rao_bound(bearings, target.p_ecef);
  if (!bound) return std::nullopt;
  const Eigen::Matrix3d& R_ecef_enu = world.site().R_ecef_enu();
  return R_ecef_enu.transpose() * *bound * R_ecef_enu;
}

}  // namespace ols::sim
