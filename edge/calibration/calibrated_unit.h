// A pan-tilt unit with a calibration. It converts between the angles that the unit reports and
// ideal angles. Pure.
#pragma once

#include "edge/mount/approach_history.h"
#include "geometry/station_calibration.h"

namespace ols::station {

class CalibratedUnit {
 public:
  explicit CalibratedUnit(const StationCalibration& calibration);

  const StationCalibration& calibration() const { return calibration_; }
  // Adds these variances to those of the calibration's heading and tilts, because the station was
  // knocked. They replace the variances of an earlier call.
  void doubt_setup(double heading_variance_rad2, double tilt_variance_rad2);

  // Sets the size of a count [rad] as the unit reports it. The unit rounds this size; the exact
  // size is a turn divided by a whole number. The reported size is used only to convert reported
  // angles to counts.
  void set_count(const PanTilt& count_rad);
  // Whether the step mode is that of the calibration, so that a turn has the same number of counts.
  bool fits() const { return fits_; }

  UnitReading reading(const PanTilt& reported, const PanTilt& rate_rad_s,
                      const mount::Approach& approach) const;
  PanTilt corrected(const UnitReading& reading) const {
    return corrected_angles(calibration_.model, reading);
  }
  // The angles that the unit reports when it points in the direction of the ideal angles
  // `corrected`. It has moved there directly from the reported angles `here`, to which it had come
  // from the directions in `approach`. `corrected` must include whole turns of the pan axis,
  // because the side from which the unit approaches them depends on the whole turns.
  PanTilt reported(const PanTilt& corrected, const PanTilt& here,
                   const mount::Approach& approach) const;

 private:
  StationCalibration calibration_;
  // What doubt_setup() has added to the variances: of the heading; of each tilt.
  Eigen::Vector2d doubt_rad2_ = Eigen::Vector2d::Zero();
  PanTilt count_rad_;
  bool fits_ = true;
};

}  // namespace ols::station
