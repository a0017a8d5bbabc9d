// Determines the focal length of a lens at one zoom position, from pictures of still scenery at pan
// angles that the unit has counted. The unit's counts are the measure. Pure.
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
  double sd_px = 0.0;  // of each coordinate of the difference
};

struct ZoomFitOptions {
  double angle_sd_rad = 5e-5;  // 1-sigma of an angle of the unit, without the common part
  double centre_sd_px = 10.0;  // prior of the principal point
  double k1_sd = 0.05;         // prior of the radial distortion
};

struct ZoomFit {
  ZoomPoint point;      // without its position; sd 0: a pair of pictures in which nothing agrees
  int used = 0;         // number of pairs; the others disagree
  double rms_sd = 0.0;  // residual RMS in its own deviations: 1 is as expected
  explicit operator bool() const { return used > 0; }
};

// `station`: as far as it is known; the focal length must be right to a tenth. `angles`: of each
// picture.
ZoomFit fit_zoom(const StationGeometry& station, const std::vector<PanTilt>& angles,
                 const std::vector<ZoomPair>& pairs, const ZoomFitOptions& options = {});

}  // namespace ols::calibration
