#include "edge/calibration/calibrated_unit.h"

#include <cmath>

#include "edge/calibration/unit_count.h"

namespace ols::station {
CalibratedUnit::CalibratedUnit(const StationCalibration& calibration)
    : calibration_(calibration),
      count_rad_{count_of(calibration.model.pan), count_of(calibration.model.tilt)} {}

void CalibratedUnit::doubt_setup(double heading_variance_rad2, double tilt_variance_rad2) {
  const Eigen::Vector2d doubt(heading_variance_rad2, tilt_variance_rad2);
  const Eigen::Vector2d more = doubt - doubt_rad2_;
  calibration_.covariance(kHeading, kHeading) += more.x();
  for (const int k : {kTiltX, kTiltY}) calibration_.covariance(k, k) += more.y();
  doubt_rad2_ = doubt;
}

void CalibratedUnit::set_count(const PanTilt& count_rad) {
  fits_ = is_count_of(calibration_.model.pan, count_rad.pan_rad) &&
          is_count_of(calibration_.model.tilt, count_rad.tilt_rad);
  if (fits_) count_rad_ = count_rad;
}

UnitReading CalibratedUnit::reading(const PanTilt& reported, const PanTilt& rate_rad_s,
                                    const mount::Approach& approach) const {
  return {{reported.pan_rad / count_rad_.pan_rad, rate_rad_s.pan_rad / count_rad_.pan_rad,
           approach.pan},
          {reported.tilt_rad / count_rad_.tilt_rad, rate_rad_s.tilt_rad / count_rad_.tilt_rad,
           approach.tilt}};
}

// A short way does not take the backlash out: the shaft stays on the side that it was on.
PanTilt CalibratedUnit::reported(const PanTilt& corrected, const PanTilt& here,
                                 const mount::Approach& approach) const {
  const auto side = [](double way_rad, double backlash_rad, int standing) {
    if (std::abs(way_rad) <= 2.0 * std::abs(backlash_rad)) return standing;
    return way_rad > 0.0 ? 1 : -1;
  };
  const StationModel& model = calibration_.model;
  const PanTilt stands = this->corrected(reading(here, {}, approach));
  const UnitCounts counts = counts_for(
      model, corrected,
      side(corrected.pan_rad - stands.pan_rad, model.pan.backlash_rad, approach.pan),
      side(corrected.tilt_rad - stands.tilt_rad, model.tilt.backlash_rad, approach.tilt));
  return {counts.pan * count_rad_.pan_rad, counts.tilt * count_rad_.tilt_rad};
}

}  // namespace ols::station
