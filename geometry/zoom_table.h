// A calibrated zoom lens: the camera at some zoom positions, and between them. Pure.
#pragma once

#include <vector>

#include "geometry/lens.h"

namespace ols {

// The camera at one zoom position (0 widest .. 1 longest), with the errors that its calibration
// left.
struct ZoomPoint {
  double position = 0.0;
  CameraIntrinsics camera;
  double focal_sd_px = 0.0;   // 1-sigma of fx and fy, which err together
  double centre_sd_px = 0.0;  // 1-sigma of the principal point, each axis
};

class ZoomTable {
 public:
  // At least two points. Throws std::invalid_argument, naming the point (counted from 1), for
  // positions that do not rise or are outside 0..1, and for a focal length that is not positive or
  // does not rise.
  explicit ZoomTable(std::vector<ZoomPoint> points);

  // Between the points, the logarithm of the focal length and all other values are linear in the
  // position. Each deviation is the larger one of the two neighbours'. The focal length's deviation
  // also includes the curvature between the points (from the difference of the slopes on both
  // sides) and the position's own 1-sigma. Outside the table, the nearest point's values hold.
  ZoomPoint at(double position, double position_sd) const;

  const std::vector<ZoomPoint>& points() const { return points_; }

 private:
  double slope(std::size_t interval) const;
  double bend(std::size_t interval) const;

  std::vector<ZoomPoint> points_;
};

}  // namespace ols
