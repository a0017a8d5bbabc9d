// The motion model, eq. (2)-(4), over the ego-motion of the camera.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/particle.h"
#include "edge/tracker/random.h"
#include "edge/tracker/tracker_config.h"

namespace ols::tracker {

// What is known of the camera's motion between two frames.
struct CameraMotion {
  // Previous frame's pixels to this frame's; nothing when unknown.
  std::optional<Eigen::Matrix3d> homography;
  double interval_s = 0.0;
};

// What a motion model can say something about: after a longer gap the target may be anywhere, and
// two exposures are not nearer to each other.
double usable_interval_s(double from_s, double to_s);

// The particle within a frame's size of the frame, no faster than ten of its widths a second, no
// larger than it: whatever clocks, homographies and hints say, pixels stay numbers.
Particle bounded(const Particle& particle, const cv::Size& frame);

// Particles carry velocities against the scene. Where the homography is not known, the camera is
// taken to turn on as before; when it is known again, the difference goes to the velocities, so
// that the particles' motion in the image stays continuous.
class MotionModel {
 public:
  explicit MotionModel(const TrackerConfig& config) : config_(config) {}

  // Takes the camera's motion at `pixel` (of the previous frame) into account for the steps below.
  // What the velocities against the scene [px/s] change by.
  Eigen::Vector2d begin_frame(const CameraMotion& motion, const Eigen::Vector2d& pixel);

  // Where the particle would be without noise.
  Particle advance(const Particle& particle) const;
  // Eq. (2)-(4)'s noise, on a particle that stands in this frame.
  Particle disturbed(const Particle& particle, Random& random) const;

  const std::optional<Eigen::Matrix3d>& homography() const { return motion_.homography; }
  double interval_s() const { return motion_.interval_s; }
  // Where the scene at this pixel of the previous frame is now.
  Eigen::Vector2d still(const Eigen::Vector2d& pixel) const;
  // The velocity of something that stands still in the image.
  Eigen::Vector2d image_fixed_velocity() const { return -camera_rate_px_s_; }
  // Standard deviation of eq. (2)'s noise for a box of this size.
  double position_sd(const Eigen::Vector2d& size_px) const;

 private:
  TrackerConfig config_;
  CameraMotion motion_;
  Eigen::Vector2d camera_rate_px_s_ = Eigen::Vector2d::Zero();  // of the scene in the image
  bool rate_known_ = false;
};

}  // namespace ols::tracker
