// A unit with a calibration: from what it reports to the angles of one without errors, and back.
// Pure.
#pragma once

#include "edge/ptu/angle_history.h"
#include "edge/ptu/approach_history.h"
#include "geometry/station_calibration.h"

namespace ols::station {

class CalibratedUnit {
 public:
  explicit CalibratedUnit(const StationCalibration& calibration);

  const StationCalibration& calibration() const { return calibration_; }
  // More is unknown of heading and tilts than the calibration says, by so much: a station that was
  // knocked.
  void doubt_setup(double heading_variance_rad2, double tilt_variance_rad2);

  // What the unit says that a count is [rad]. It rounds: a count is the exact fraction of a turn,
  // and what the unit says only tells how many counts a reported angle is.
  void set_count(const PanTilt& count_rad);
  // Whether a turn has as many counts as the calibration says: the step mode is the same.
  bool fits() const { return fits_; }

  // In time order.
  void add(const ptu::AngleSample& sample) { approach_.add(sample.time_s, sample.angles); }
  void forget_angles() { approach_.clear(); }

  UnitReading reading(const PanTilt& reported, const PanTilt& rate_rad_s, double time_s) const;
  PanTilt corrected(const UnitReading& reading) const {
    return corrected_angles(calibration_.model, reading);
  }
  // The reported angles at which the unit, coming straight from `here`, stands as one without
  // errors would. `corrected` is the turn of pan that it goes to: of two that differ by a whole
  // one, the unit comes to each from its own side.
  PanTilt reported(const PanTilt& corrected, const PanTilt& here) const;

 private:
  StationCalibration calibration_;
  Eigen::Vector2d doubt_rad2_ = Eigen::Vector2d::Zero();  // in its covariance: heading, each tilt
  PanTilt count_rad_;
  bool fits_ = true;
  ptu::ApproachHistory approach_;
};

}  // namespace ols::station
