// The tracker once it has a target: one step of the paper's section 5 a frame. Input is checked by
// tracker.h.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/belief.h"
#include "edge/tracker/designation.h"
#include "edge/tracker/particle_filter.h"
#include "edge/tracker/point_measurement.h"
#include "edge/tracker/reacquisition.h"
#include "edge/tracker/scene_motion.h"
#include "edge/tracker/target_model.h"

namespace ols::tracker {

class TrackerCore {
 public:
  TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
              const cv::Rect2d& box);

  TrackerOutput step(const TrackerInput& frame, StageTimer& timer);
  void search_near(const Eigen::Vector2d& pixel, double sd_px);
  // By the image alone, the previous frame's pixels to the newest one's; nothing without texture.
  const std::optional<Eigen::Matrix3d>& image_homography() const {
    return scene_motion_.image_homography();
  }

 private:
  enum class Velocity { kEstimated, kUnknown };

  TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
              const cv::Rect2d& box, const cv::Rect2d& core);

  EgoMotion move_camera(const TrackerInput& frame, StageTimer& timer);
  void designate_late(const cv::Mat& gray);
  void predict(EgoMotion ego_motion, StageTimer& timer);
  void propose(EgoMotion ego_motion);
  void move_half_by_other();
  void guess_velocities();
  void force_onto_differences(const cv::Rect2d& area);
  Eigen::Vector2d expected_px() const;
  Eigen::Vector2d unmoved_px() const;
  cv::Rect2d reachable_area() const;
  TrackerOutput update(const TrackerInput& frame, StageTimer& timer);
  void weigh_particles(const Scene& scene);
  std::size_t choose(const Scene& scene) const;
  TrackerOutput locate(const Scene& scene, std::size_t best);
  void judge(const Scene& scene);
  void learn(const Scene& scene);
  void after_update(const TrackerOutput& output);
  void propose_usual_size();
  double reach_px() const;
  bool beyond_reach(const Eigen::Vector2d& pixel) const;
  bool followed() const;

  TrackerConfig config_;
  Random random_;
  SceneMotion scene_motion_;
  MotionModel motion_;
  ParticleFilter filter_;
  TargetModel target_;
  Belief belief_;
  Designation designation_;
  PointMeasurement measurement_;
  Particle last_;  // best estimate in the newest frame
  Reacquisition reacquisition_;
  Velocity velocity_ = Velocity::kUnknown;
  // By the mount's homography from where the image's takes the target, where the two disagree.
  std::optional<Eigen::Vector2d> other_step_px_;
  bool placed_ = false;  // particles and last_ stand in the coming frame already
};

}  // namespace ols::tracker
