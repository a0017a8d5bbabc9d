// Determines the focal length of a lens at one zoom position, from pictures of still scenery at
// different pan angles. The unit's counts give the pan angles, and thereby the scale. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/sight.h"
#include "geometry/zoom_table.h"

namespace ols::calibration {

// A point of the scenery in two pictures.
struct ZoomPair {
  std::size_t first = 0, second = 0;
  Eigen::Vector2d first_px = Eigen::Vector2d::Zero(), second_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of each coordinate of the difference
};

struct ZoomFitOptions {
  // 1-sigma of an angle of the unit, without the error that is common to all angles.
  double angle_sd_rad = 5e-5;
  double centre_sd_px = 10.0;  // 1-sigma of the prior of the principal point
  double k1_sd = 0.05;         // 1-sigma of the prior of the radial distortion
};

struct ZoomFit {
  ZoomPoint point;      // its zoom position is not set
  int used = 0;         // number of pairs that agree
  double rms_sd = 0.0;  // RMS of the residuals, each divided by its 1-sigma; 1 is expected
  explicit operator bool() const { return used > 0; }
};

// `station`: the station as far as it is known; its focal length must be right to within 10 %.
// `angles`: one pan and tilt for each picture.
ZoomFit fit_zoom(const StationGeometry& station, const std::vector<PanTilt>& angles,
                 const std::vector<ZoomPair>& pairs, const ZoomFitOptions& options = {});

}  // namespace ols::calibration
