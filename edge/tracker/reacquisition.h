// Where a lost target is searched for, and which candidates are accepted. TrackerCore::propose()
// gives the order of the search.
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
  // The search region, in the present frame's pixels.
  struct Region {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double sd_px = 0.0;
    double most_sd_px = 0.0;
    double since_s = 0.0;
    bool told = false;  // from start_near(): the target may also be stationary there
  };

  Reacquisition(const TrackerConfig& config, const Particle& target, double time_s)
      : config_(config), believed_(target), time_s_(time_s) {}

  bool searching() const { return region_.has_value(); }
  const std::optional<Region>& region() const { return region_; }
  // The target when last believed, mapped to the newest frame.
  const Particle& believed() const { return believed_; }
  // Probability that the tracked object is the designated target, and not a similar one.
  double identity() const { return identity_; }

  // Starts tracking; forgets the previous target.
  void restart(const Particle& target);
  // The target was seen and believed.
  void see(const Particle& target) { believed_ = target; }
  // For a target that was found elsewhere and whose velocity is lost: particles start there with
  // the old velocity, or with none. Once the target was measured in two successive frames, `target`
  // gets the velocity between them. `unmoved_px`: its position if it had not moved.
  void learn_velocity(bool measured, const Eigen::Vector2d& unmoved_px, double interval_s,
                      Particle& target);
  // The target is believed: ends the search.
  void end();
  // The target is lost. `sd_px`: the uncertainty of its expected position.
  void start(double sd_px);
  // A caller reports the target near `pixel`.
  void start_near(const Eigen::Vector2d& pixel, double sd_px);

  // The change of the velocities relative to the scene.
  void change_velocity(const Eigen::Vector2d& change_px_s) {
    believed_.velocity_px_s += change_px_s;
  }
  // Advances target and region to the newest frame, unless already done.
  void predict(const MotionModel& motion, const SceneMotion& scene, bool placed);
  // Redraws a share of the particles over the region.
  void scatter(std::vector<Particle>& particles, Random& random) const;
  // Detects movers, first near the expected position, then anywhere, and puts a share of the
  // particles there.
  void look_for_movers(const SceneMotion& scene, const Eigen::Vector2d& size_px);
  void force_onto_movers(std::vector<Particle>& particles, Random& random) const;
  Particle drawn_near(const Eigen::Vector2d& pixel, double sd_px, Random& random) const;

  // Whether the particle may be the target. After a loss, a stationary object away from the
  // prediction is not accepted, even if it looks similar: it is a twig, a window or a reticle.
  bool may_be_it(const Particle& particle) const;
  // Shares the probability of identity among candidates: an object found elsewhere may be any of
  // the similar movers, visible or hidden, and nothing distinguishes them.
  void identify(const Particle& found, const Scene& scene, const TargetModel& target,
                const Belief& belief);

 private:
  bool near_prediction(const Particle& particle) const;
  bool looks_near_first() const;
  double identity_of(const Particle& found, const Scene& scene, const TargetModel& target,
                     const Belief& belief) const;

  TrackerConfig config_;
  std::optional<Region> region_;
  std::vector<MoverCandidate> movers_;  // of the newest frame
  Particle believed_;
  double believed_identity_ = 1.0;  // when last believed
  double identity_ = 1.0;
  bool measured_ = false, measured_before_ = false;  // in this frame and in the one before
  double time_s_;
  double unaligned_since_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace ols::tracker
