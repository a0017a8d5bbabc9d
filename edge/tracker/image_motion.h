// The camera's motion between two frames, measured in the images alone.
#pragma once

#include <Eigen/Core>

namespace ols::tracker {

struct ImageMotion {
  Eigen::Matrix3d homography;  // maps full-frame pixels of the earlier frame to the later one
  // The middle of the corners that agree with it, in the earlier frame: there the motion is known
  // best, with this 1-sigma in each direction.
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
};

}  // namespace ols::tracker
