// A station whose parameters an adjustment has found: sight with the whole covariance of the
// parameters behind it, and its inverse. docs/calibration.md.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/station_model.h"

namespace ols {

using ModelCovariance = Eigen::Matrix<double, kModelParameters, kModelParameters>;

struct StationCalibration {
  StationModel model;
  ModelCovariance covariance = ModelCovariance::Zero();  // in the order of Parameter
  double angle_sd_rad = 0.0;  // of each angle of a pose, new with every pose
};

// One measured pixel with what the unit reports of its exposure.
struct CountedSight {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();             // white
  Eigen::Matrix2d covariance_systematic_px2 = Eigen::Matrix2d::Zero();  // stays (designation)
  // `approach` may be 0: not known; then the backlash is in the systematic covariance.
  UnitReading reading;
  Eigen::Matrix2d angles_covariance_rad2 = Eigen::Matrix2d::Zero();  // white, (pan, tilt)
};

// J C J' on the tangent plane (cross-elevation, elevation) [rad^2]: what the errors of all
// parameters make of the direction of a pixel. Nothing when the pixel cannot be unprojected.
std::optional<Eigen::Matrix2d> systematic_covariance(const StationCalibration& calibration,
                                                     const UnitReading& reading,
                                                     const Eigen::Vector2d& pixel);

// As sight() of geometry/sight.h; the systematic covariance is J C J' and the designation's.
std::optional<LineOfSight> sight(const StationCalibration& calibration,
                                 const CountedSight& measurement);

// The counts at which a shaft stands at this angle [rad], reached in this direction (1, -1; 0: in
// the middle of the backlash). Newton on shaft_angle(), whose derivative is 1 within some
// thousandths.
double counts_for_shaft(const AxisModel& axis, int sign, double zero_rad, double shaft_rad,
                        int approach);

// The inverse of corrected_angles() for a unit that stands: the counts at which a unit with these
// errors points where one without errors would at these angles.
struct UnitCounts {
  double pan = 0.0, tilt = 0.0;
};
UnitCounts counts_for(const StationModel& model, const PanTilt& corrected, int approach_pan,
                      int approach_tilt);

}  // namespace ols
