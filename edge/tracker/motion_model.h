// The motion model, eq. (2)-(4), including the ego-motion of the camera.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/particle.h"
#include "edge/tracker/random.h"
#include "edge/tracker/tracker_config.h"

namespace ols::tracker {

// The camera's motion between two frames.
struct CameraMotion {
  // Maps the previous frame's pixels to this frame's; nullopt if unknown.
  std::optional<Eigen::Matrix3d> homography;
  double interval_s = 0.0;
};

// The interval between two frames, limited to 0.1 ms .. 1 s. Two exposures are never closer than
// 0.1 ms. After more than 1 s, the target may be anywhere.
double usable_interval_s(double from_s, double to_s);

// Limits the particle's position to one frame size outside the frame, its velocity to ten frame
// widths a second, and its size to 3 px .. the frame's size. Pixel values therefore cannot
// overflow, whatever the clock, the homography or the caller of search_near() says.
Particle bounded(const Particle& particle, const cv::Size& frame);

// Applies the motion model to particles, whose velocities are relative to the scene. Without a
// homography, the camera is assumed to keep turning at its last known rate. When the homography is
// known again, the error of this assumption is added to the velocities, so that the particles move
// continuously in the image.
class MotionModel {
 public:
  explicit MotionModel(const TrackerConfig& config) : config_(config) {}

  // Starts a frame: the functions below use this motion of the camera. Its rate in the image [px/s]
  // is taken at `pixel` of the previous frame. Returns the change [px/s] that the caller must add
  // to all velocities relative to the scene; see the class.
  Eigen::Vector2d begin_frame(const CameraMotion& motion, const Eigen::Vector2d& pixel);

  // The particle's prediction without noise.
  Particle advance(const Particle& particle) const;
  // Adds the noise of eq. (2)-(4) to a particle that is already advanced to this frame.
  Particle disturbed(const Particle& particle, Random& random) const;

  const std::optional<Eigen::Matrix3d>& homography() const { return motion_.homography; }
  double interval_s() const { return motion_.interval_s; }
  // The pixel in this frame of a point of the scene that was at `pixel` in the previous frame.
  Eigen::Vector2d still(const Eigen::Vector2d& pixel) const;
  // The velocity, relative to the scene, of an object that is stationary in the image.
  Eigen::Vector2d image_fixed_velocity() const { return -camera_rate_px_s_; }
  // Standard deviation of the position noise of eq. (2) for a box of this size.
  double position_sd(const Eigen::Vector2d& size_px) const;

 private:
  TrackerConfig config_;
  CameraMotion motion_;
  Eigen::Vector2d camera_rate_px_s_ = Eigen::Vector2d::Zero();  // motion of the scene in the image
  bool rate_known_ = false;
};

}  // namespace ols::tracker
