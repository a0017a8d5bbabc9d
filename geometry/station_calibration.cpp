#include "geometry/station_calibration.h"

#include <cmath>

#include "geometry/angles.h"
#include "geometry/pixel_prediction.h"

namespace ols {
namespace {

// Where the direction of approach is not known, the shaft stands half a backlash to one side or to
// the other.
Eigen::Matrix2d unknown_side(const StationCalibration& calibration, const UnitReading& reading,
                             const Eigen::Vector2d& pixel) {
  UnitReading one_side = reading;
  for (AxisReading* axis : {&one_side.pan, &one_side.tilt}) {
    if (axis->approach == 0) axis->approach = 1;
  }
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  const auto seen = predict_direction(calibration.model, one_side, pixel);
  if (!seen) return covariance;
  const auto add = [&](const AxisReading& axis, double backlash_rad, int parameter) {
    if (axis.approach != 0) return;
    const Eigen::Vector2d by = seen->by_parameters.col(parameter);
    covariance += by * by.transpose() *
                  (backlash_rad * backlash_rad + calibration.covariance(parameter, parameter));
  };
  add(reading.pan, calibration.model.pan.backlash_rad, kPanBacklash);
  add(reading.tilt, calibration.model.tilt.backlash_rad, kTiltBacklash);
  return covariance;
}

}  // namespace

std::optional<Eigen::Matrix2d> systematic_covariance(const StationCalibration& calibration,
                                                     const UnitReading& reading,
                                                     const Eigen::Vector2d& pixel) {
  const auto seen = predict_direction(calibration.model, reading, pixel);
  if (!seen) return std::nullopt;
  const auto& J = seen->by_parameters;
  return J * calibration.covariance * J.transpose() + unknown_side(calibration, reading, pixel);
}

std::optional<LineOfSight> sight(const StationCalibration& calibration,
                                 const CountedSight& measurement) {
  const auto systematic =
      systematic_covariance(calibration, measurement.reading, measurement.pixel);
  if (!systematic) return std::nullopt;
  // Its own deviations are those of a station without a calibration: here J C J' has them all.
  StationGeometry geometry = calibration.model.geometry;
  geometry.sd = {};
  PixelSight pixel;
  pixel.pixel = measurement.pixel;
  pixel.covariance_px2 = measurement.covariance_px2;
  pixel.aim_sd_px = measurement.aim_sd_px;
  pixel.angles = corrected_angles(calibration.model, measurement.reading);
  pixel.angles_covariance_rad2 =
      measurement.angles_covariance_rad2 +
      Eigen::Matrix2d::Identity() * (calibration.angle_sd_rad * calibration.angle_sd_rad);
  pixel.angles_systematic_rad2 = measurement.angles_systematic_rad2;
  auto line = sight(geometry, pixel);
  if (!line) return std::nullopt;
  line->covariance_systematic += *systematic;
  for (int i = 0; i < 3; ++i) {
    line->origin_sd_enu_m[i] = std::sqrt(calibration.covariance(kEast + i, kEast + i));
  }
  return line;
}

double counts_for_shaft(const AxisModel& axis, int sign, double zero_rad, double shaft_rad,
                        int approach) {
  constexpr int kIterations = 20;
  constexpr double kConverged_rad = 1e-12;
  const double counts_per_rad = sign * static_cast<double>(axis.counts_per_turn) / (2.0 * kPi);
  AxisReading reading{(shaft_rad - zero_rad) * counts_per_rad, 0.0, approach};
  for (int i = 0; i < kIterations; ++i) {
    const ShaftAngle shaft = shaft_angle(axis, sign, zero_rad, reading, 0.0);
    const double off_rad = shaft_rad - shaft.rad;
    reading.counts += off_rad / shaft.by_nominal * counts_per_rad;
    if (std::abs(off_rad) < kConverged_rad) break;
  }
  return reading.counts;
}

UnitCounts counts_for(const StationModel& model, const PanTilt& corrected, int approach_pan,
                      int approach_tilt) {
  const ChainParameters& chain = model.geometry.chain;
  const double pan_rad = chain.pan_sign * corrected.pan_rad + chain.pan_zero_rad;
  const double tilt_rad = chain.tilt_sign * corrected.tilt_rad + chain.tilt_zero_rad;
  return {
      counts_for_shaft(model.pan, chain.pan_sign, chain.pan_zero_rad, pan_rad, approach_pan),
      counts_for_shaft(model.tilt, chain.tilt_sign, chain.tilt_zero_rad, tilt_rad, approach_tilt)};
}

}  // namespace ols
