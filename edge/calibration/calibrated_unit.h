// A pan-tilt unit with a calibration: converts between the angles that the unit reports and ideal
// angles. Pure.
#pragma once

#include "edge/mount/approach_history.h"
#include "geometry/station_calibration.h"

namespace ols::station {

class CalibratedUnit {
 public:
  explicit CalibratedUnit(const StationCalibration& calibration);

  const StationCalibration& calibration() const { return calibration_; }
  // Adds variances to the heading and the tilts of the calibration, because the station was
  // knocked.
  void doubt_setup(double heading_variance_rad2, double tilt_variance_rad2);

  // The size of a count [rad] as the unit reports it, which is rounded. It is used only to convert
  // reported angles to counts. The exact size is a fraction of a turn.
  void set_count(const PanTilt& count_rad);
  // Whether a turn has as many counts as in the calibration, so that the step mode is the same.
  bool fits() const { return fits_; }

  UnitReading reading(const PanTilt& reported, const PanTilt& rate_rad_s,
                      const mount::Approach& approach) const;
  PanTilt corrected(const UnitReading& reading) const {
    return corrected_angles(calibration_.model, reading);
  }
  // The angles that the unit reports when it has come straight from `here`, where it stands after
  // `approach`, and points where an ideal unit points at `corrected`. `corrected` must include
  // whole turns of the pan axis, because angles a whole turn apart are approached from different
  // sides.
  PanTilt reported(const PanTilt& corrected, const PanTilt& here,
                   const mount::Approach& approach) const;

 private:
  StationCalibration calibration_;
  // Added to the calibration's variances: heading, each tilt.
  Eigen::Vector2d doubt_rad2_ = Eigen::Vector2d::Zero();
  PanTilt count_rad_;
  bool fits_ = true;
};

}  // namespace ols::station
