// The tracker of one target: performs one step of the paper's section 5 for each frame. Tracker
// (tracker.h) has checked the input.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/belief.h"
#include "edge/tracker/designation.h"
#include "edge/tracker/particle_filter.h"
#include "edge/tracker/point_measurement.h"
#include "edge/tracker/reacquisition.h"
#include "edge/tracker/recognition.h"
#include "edge/tracker/scene_motion.h"
#include "edge/tracker/target_model.h"

namespace ols::tracker {

class TrackerCore {
 public:
  TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
              const cv::Rect2d& box);

  TrackerOutput step(const TrackerInput& frame, StageTimer& timer);
  void search_near(const Eigen::Vector2d& pixel, double sd_px);
  // The camera's motion from the previous frame to the newest one; nullopt without texture.
  const std::optional<ImageMotion>& image_motion() const { return scene_motion_.image_motion(); }

 private:
  enum class Velocity { kEstimated, kUnknown };

  TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
              const cv::Rect2d& box, const cv::Rect2d& core);

  EgoMotion move_camera(const TrackerInput& frame, StageTimer& timer);
  void designate_late(const TrackerInput& frame);
  bool recognise(const TrackerInput& frame);
  void predict(EgoMotion ego_motion, StageTimer& timer);
  void propose(EgoMotion ego_motion);
  void force_onto_differences(const cv::Rect2d& area);
  Eigen::Vector2d expected_px() const;
  Eigen::Vector2d unmoved_px() const;
  cv::Rect2d reachable_area() const;
  TrackerOutput follow(const TrackerInput& frame, StageTimer& timer);
  TrackerOutput update(const TrackerInput& frame, StageTimer& timer);
  void weigh_particles(const Scene& scene);
  std::size_t choose(const Scene& scene) const;
  TrackerOutput locate(const Scene& scene, const std::optional<RefinedPosition>& placed);
  void judge(const Scene& scene);
  void learn(const Scene& scene);
  void after_update(const TrackerOutput& output);
  double reach_px() const;
  bool beyond_reach(const Eigen::Vector2d& pixel) const;
  bool followed() const;

  TrackerConfig config_;
  Random random_;
  SceneMotion scene_motion_;
  MotionModel motion_;
  ParticleFilter filter_;
  TargetModel target_;
  Recognition recognition_;
  Belief belief_;  // decides whether the target must be searched for
  Designation designation_;
  PointMeasurement measurement_;
  Particle last_;  // the best estimate in the newest frame
  Reacquisition reacquisition_;
  Velocity velocity_ = Velocity::kUnknown;
  // Image and mount both predict the target's position. If the two predictions disagree, this is
  // the step from the image's to the mount's.
  std::optional<Eigen::Vector2d> other_step_px_;
  bool placed_ = false;  // particles and last_ are already placed for the coming frame
};

}  // namespace ols::tracker
