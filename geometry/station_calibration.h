// A station whose parameters come from an adjustment (docs/calibration.md). Provides sight() with
// the full covariance of the parameters, and the inverse of sight().
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/station_model.h"

namespace ols {

using ModelCovariance = Eigen::Matrix<double, kModelParameters, kModelParameters>;

struct StationCalibration {
  StationModel model;
  ModelCovariance covariance = ModelCovariance::Zero();  // in the order of Parameter
  double angle_sd_rad = 0.0;  // 1-sigma of each angle of a pose; independent at every pose
};

// One measured pixel, with the unit's readings at its exposure.
struct CountedSight {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // white
  double aim_sd_px = 0.0;  // 1-sigma of each coordinate, from the designation
  // If `approach` is 0 (unknown), the backlash is part of the systematic covariance.
  UnitReading reading;
  Eigen::Matrix2d angles_covariance_rad2 = Eigen::Matrix2d::Zero();  // white, (pan, tilt)
  // The same in every frame; without the errors that the calibration's covariance contains.
  Eigen::Matrix2d angles_systematic_rad2 = Eigen::Matrix2d::Zero();
};

// J C J' on the tangent plane (cross-elevation, elevation) [rad^2]: the covariance of a pixel's
// direction due to the errors of all parameters. nullopt when the pixel cannot be unprojected.
std::optional<Eigen::Matrix2d> systematic_covariance(const StationCalibration& calibration,
                                                     const UnitReading& reading,
                                                     const Eigen::Vector2d& pixel);

// Like sight() of geometry/sight.h. The systematic covariance is the sum of three parts: J C J',
// the part due to the designation, and the part due to angles_systematic_rad2.
std::optional<LineOfSight> sight(const StationCalibration& calibration,
                                 const CountedSight& measurement);

// The counts at which a shaft has this angle [rad]; the inverse of shaft_angle(). `approach`:
// direction of the last motion (1 or -1; 0: the middle of the backlash). Solved by Newton's method,
// which converges fast because the derivative of shaft_angle() differs from 1 only by some
// thousandths.
double counts_for_shaft(const AxisModel& axis, int sign, double zero_rad, double shaft_rad,
                        int approach);

// The inverse of corrected_angles() for a unit at rest: the counts at which this unit, with its
// errors, has the direction that an ideal unit has at the angles `corrected`.
struct UnitCounts {
  double pan = 0.0, tilt = 0.0;
};
UnitCounts counts_for(const StationModel& model, const PanTilt& corrected, int approach_pan,
                      int approach_tilt);

}  // namespace ols
