// The focal length of a lens at one zoom position, from pictures of still scenery at pan angles
// that the unit has counted: the unit is the ruler. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/sight.h"
#include "geometry/zoom_table.h"

namespace ols::calibration {

// A point of the scenery in two of the pictures.
struct ZoomPair {
  std::size_t first = 0, second = 0;
  Eigen::Vector2d first_px = Eigen::Vector2d::Zero(), second_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // of a coordinate of their difference
};

struct ZoomFitOptions {
  double angle_sd_rad = 5e-5;  // 1-sigma of an angle of the unit, without what all have in common
  double centre_sd_px = 10.0;  // of the principal point, before
  double k1_sd = 0.05;         // of the radial distortion, before
};

struct ZoomFit {
  ZoomPoint point;      // without its position; a pair of pictures in which nothing agrees: sd 0
  int used = 0;         // pairs; the others disagree with them
  double rms_sd = 0.0;  // of what is left, in its own deviations: 1 is as expected
  explicit operator bool() const { return used > 0; }
};

// `station`: as it is known, with a focal length that is right to a tenth. `angles`: of each
// picture.
ZoomFit fit_zoom(const StationGeometry& station, const std::vector<PanTilt>& angles,
                 const std::vector<ZoomPair>& pairs, const ZoomFitOptions& options = {});

}  // namespace ols::calibration
