// What the facade of tracker.h holds once it has a target: the paper's filter or the full one.
// Input has been checked.
#pragma once

#include "edge/tracker/stage_times.h"
#include "edge/tracker/tracker.h"

namespace ols {

class TargetFollower {
 public:
  virtual ~TargetFollower() = default;
  virtual TrackerOutput step(const TrackerInput& frame, StageTimer& timer) = 0;
  // By the image alone, the previous frame's pixels to the newest one's; nothing without texture.
  virtual const std::optional<Eigen::Matrix3d>& image_homography() const = 0;
  virtual void search_near(const Eigen::Vector2d& pixel, double sd_px) = 0;
};

}  // namespace ols
