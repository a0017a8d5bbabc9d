// A pan-tilt unit with a calibration: converts between the angles that it reports and ideal angles.
// Pure.
#pragma once

#include "edge/mount/angle_history.h"
#include "edge/mount/approach_history.h"
#include "geometry/station_calibration.h"

namespace ols::station {

class CalibratedUnit {
 public:
  explicit CalibratedUnit(const StationCalibration& calibration);

  const StationCalibration& calibration() const { return calibration_; }
  // Adds variances to the calibration's heading and tilts, because the station was knocked.
  void doubt_setup(double heading_variance_rad2, double tilt_variance_rad2);

  // The size of a count [rad] as the unit reports it, rounded. It is used only to convert reported
  // angles to counts, because a count is an exact fraction of a turn.
  void set_count(const PanTilt& count_rad);
  // Whether a turn has as many counts as in the calibration: the step mode is the same.
  bool fits() const { return fits_; }

  // In time order.
  void add(const mount::AngleSample& sample) { approach_.add(sample.time_s, sample.angles); }
  void forget_angles() { approach_.clear(); }

  UnitReading reading(const PanTilt& reported, const PanTilt& rate_rad_s, double time_s) const;
  PanTilt corrected(const UnitReading& reading) const {
    return corrected_angles(calibration_.model, reading);
  }
  // The reported angles at which the unit, coming straight from `here`, stands at ideal angles.
  // `corrected` also says in which turn pan is: the unit approaches angles that are a whole turn
  // apart from different sides.
  PanTilt reported(const PanTilt& corrected, const PanTilt& here) const;

 private:
  StationCalibration calibration_;
  Eigen::Vector2d doubt_rad2_ = Eigen::Vector2d::Zero();  // added to its covariance: heading, each
                                                          // tilt
  PanTilt count_rad_;
  bool fits_ = true;
  mount::ApproachHistory approach_;
};

}  // namespace ols::station
