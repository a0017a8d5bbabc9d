// A calibrated zoom lens: the camera at measured zoom positions, and interpolated between them.
// Pure.
#pragma once

#include <vector>

#include "geometry/lens.h"

namespace ols {

// The camera at one zoom position (0 widest .. 1 longest), with the errors that remain after its
// calibration.
struct ZoomPoint {
  double position = 0.0;
  CameraIntrinsics camera;
  double focal_sd_px = 0.0;   // 1-sigma of fx and fy; their errors are the same
  double centre_sd_px = 0.0;  // 1-sigma of the principal point, each axis
};

class ZoomTable {
 public:
  // `points`: at least two. Throws std::invalid_argument, naming the point (counted from 1), if
  // positions do not rise or are outside 0..1, or if a focal length is not positive or does not
  // rise.
  explicit ZoomTable(std::vector<ZoomPoint> points);

  // Between the points, the logarithm of the focal length and all other values are linear in the
  // position. Each deviation is the larger of those at the two neighbouring points. The focal
  // length's deviation also includes the curvature between the points (from the difference of the
  // slopes on both sides) and the 1-sigma of the position. Outside the table, the values of the
  // nearest point apply.
  ZoomPoint at(double position, double position_sd) const;

  const std::vector<ZoomPoint>& points() const { return points_; }

 private:
  double slope(std::size_t interval) const;
  double bend(std::size_t interval) const;

  std::vector<ZoomPoint> points_;
};

}  // namespace ols
