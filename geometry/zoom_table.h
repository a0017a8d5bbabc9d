// A zoom lens as a calibration found it: the camera at some positions of the zoom, and between
// them. Pure.
#pragma once

#include <vector>

#include "geometry/pinhole.h"

namespace ols {

// The camera at one zoom position (0 widest .. 1 longest), with what its calibration left.
struct ZoomPoint {
  double position = 0.0;
  CameraIntrinsics camera;
  double focal_sd_px = 0.0;   // 1-sigma of fx and fy, which err together
  double centre_sd_px = 0.0;  // 1-sigma of the principal point, each axis
};

class ZoomTable {
 public:
  // At least two points. Throws std::invalid_argument, naming the point from 1: positions that do
  // not rise, or are outside 0..1; a focal length that is not positive or does not rise.
  explicit ZoomTable(std::vector<ZoomPoint> points);

  // Between the points the logarithm of the focal length is linear in the position, and everything
  // else too. The deviations are the worse one of the neighbours', and of the focal length also
  // what bends between them (as the slopes on both sides differ) and what the position's own
  // 1-sigma means. Outside the table, the nearest point's.
  ZoomPoint at(double position, double position_sd) const;

  const std::vector<ZoomPoint>& points() const { return points_; }

 private:
  double slope(std::size_t interval) const;
  double bend(std::size_t interval) const;

  std::vector<ZoomPoint> points_;
};

}  // namespace ols
