// Decides where a lost target is searched for, and which candidates are accepted.
// TrackerCore::propose() determines the order of the search.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/belief.h"
#include "edge/tracker/motion_model.h"
#include "edge/tracker/mover_detection.h"
#include "edge/tracker/scene_motion.h"
#include "edge/tracker/target_model.h"

namespace ols::tracker {

class Reacquisition {
 public:
  // The search region, in pixels of the present frame.
  struct Region {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double sd_px = 0.0;
    double most_sd_px = 0.0;
    double since_s = 0.0;
    bool told = false;  // set by start_near(): a stationary object is accepted, too
  };

  Reacquisition(const TrackerConfig& config, const Particle& target, double time_s)
      : config_(config), believed_(target), time_s_(time_s) {}

  bool searching() const { return region_.has_value(); }
  const std::optional<Region>& region() const { return region_; }
  // The target when it was last believed, moved to the newest frame.
  const Particle& believed() const { return believed_; }
  // Probability that the tracked object is the designated target rather than a similar object.
  double identity() const { return identity_; }

  // Starts to track this target, and forgets the previous one.
  void restart(const Particle& target);
  // Notes that the target was seen and believed.
  void see(const Particle& target) { believed_ = target; }
  // Call it for each frame. `measured`: whether the target's position was measured in it. A target
  // that is found again has an unknown velocity. When it has been measured in two successive
  // frames, the velocity of `target` is set to its motion between them. `unmoved_px`: where the
  // target would be if it had not moved.
  void learn_velocity(bool measured, const Eigen::Vector2d& unmoved_px, double interval_s,
                      Particle& target);
  // Ends the search, because the target is believed.
  void end();
  // Starts the search, because the target is lost. `sd_px`: the uncertainty of its expected
  // position.
  void start(double sd_px);
  // Starts the search near `pixel`, because a caller reports the target there.
  void start_near(const Eigen::Vector2d& pixel, double sd_px);

  // Adds this change to the velocity relative to the scene.
  void change_velocity(const Eigen::Vector2d& change_px_s) {
    believed_.velocity_px_s += change_px_s;
  }
  // Moves target and region to the newest frame, unless they are `placed` there already.
  void predict(const MotionModel& motion, const SceneMotion& scene, bool placed);
  // Redraws a share of the particles all over the region.
  void scatter(std::vector<Particle>& particles, Random& random) const;
  // Detects movers: for one second near the expected position, then anywhere. force_onto_movers()
  // then puts a share of the particles on them.
  void look_for_movers(const SceneMotion& scene, const Eigen::Vector2d& size_px);
  void force_onto_movers(std::vector<Particle>& particles, Random& random) const;
  Particle drawn_near(const Eigen::Vector2d& pixel, double sd_px, Random& random) const;

  // Whether the particle can be the target. After a loss, a stationary object away from the
  // prediction is not accepted, even if it looks similar, because it is probably a twig, a window
  // or a reticle.
  bool may_be_target(const Particle& particle) const;
  // Computes identity(). An object that is found away from the prediction may be any of the similar
  // movers, visible or hidden. Nothing distinguishes them; the probability is therefore divided
  // among them.
  void identify(const Particle& found, const Scene& scene, const TargetModel& target,
                const Belief& belief);

 private:
  bool near_prediction(const Particle& particle) const;
  bool looks_near_first() const;
  double identity_of(const Particle& found, const Scene& scene, const TargetModel& target,
                     const Belief& belief) const;

  TrackerConfig config_;
  std::optional<Region> region_;
  std::vector<MoverCandidate> movers_;  // those in the newest frame
  Particle believed_;
  double believed_identity_ = 1.0;  // value when the target was last believed
  double identity_ = 1.0;
  // Whether the target was measured in this frame, and in the previous one.
  bool measured_ = false, measured_before_ = false;
  double time_s_;
  double unaligned_since_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace ols::tracker
