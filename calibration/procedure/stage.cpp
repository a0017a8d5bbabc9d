#include "calibration/procedure/stage.h"

namespace ols::calibration {

Observation observation_of(Kind kind, const Taken& picture, const Eigen::Vector2d& pixel,
                           double sd_px, std::string reference) {
  Observation one;
  one.kind = kind;
  one.pose = picture.pose;
  one.utime_us = picture.utime_us;
  one.reading = picture.reading;
  // A unit that stands is where its last report says.
  one.reading.pan.counts_per_s = one.reading.tilt.counts_per_s = 0.0;
  one.pixel = pixel;
  one.sd_px = sd_px;
  one.reference = std::move(reference);
  return one;
}

}  // namespace ols::calibration
