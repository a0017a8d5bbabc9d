// The camera's motion between two frames, measured in the images alone.
#pragma once

#include <Eigen/Core>

namespace ols::tracker {

struct ImageMotion {
  Eigen::Matrix3d homography;  // maps full-frame pixels of the earlier frame to the later one
  // The mean position, in the earlier frame, of the corners that agree with the homography. At this
  // position, the motion is known best; its 1-sigma there, in each direction, is sd_px.
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
};

}  // namespace ols::tracker
