// A calibrated zoom lens: the camera's parameters at measured zoom positions, interpolated between
// them. Pure.
#pragma once

#include <vector>

#include "geometry/lens.h"

namespace ols {

// The camera at one zoom position (0 is the widest view, 1 the longest focal length), with the
// errors that remain after calibration.
struct ZoomPoint {
  double position = 0.0;
  CameraIntrinsics camera;
  double focal_sd_px = 0.0;   // 1-sigma of fx and fy, which have the same error
  double centre_sd_px = 0.0;  // 1-sigma of the principal point, each axis
};

class ZoomTable {
 public:
  // `points`: at least two. Throws std::invalid_argument that names the point (counted from 1) if
  // positions do not increase or are outside 0..1, or if focal lengths are not positive or do not
  // increase.
  explicit ZoomTable(std::vector<ZoomPoint> points);

  // The camera at a zoom position. position_sd: 1-sigma of the position. Between the points, the
  // logarithm of the focal length is interpolated linearly, and so are the principal point, the
  // skew and the coefficients of distortion. Each deviation is the larger of those at the
  // two neighbouring points. The deviation of the focal length also includes the error of the
  // interpolation (from the change of slope between neighbouring intervals) and the effect of
  // position_sd. Outside the table, the values of the nearest point are used.
  ZoomPoint at(double position, double position_sd) const;

  const std::vector<ZoomPoint>& points() const { return points_; }

 private:
  double slope(std::size_t interval) const;
  double bend(std::size_t interval) const;

  std::vector<ZoomPoint> points_;
};

}  // namespace ols
