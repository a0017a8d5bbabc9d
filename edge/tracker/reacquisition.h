// How a target that is no longer believed in is looked for, and what may be taken for it.
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
  // Where the target is looked for, the present frame's pixels.
  struct Region {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double sd_px = 0.0;
    double most_sd_px = 0.0;
    double since_s = 0.0;
    bool told = false;  // by start_near(): it is there whether it moves or not
  };

  Reacquisition(const TrackerConfig& config, const Particle& target, double time_s)
      : config_(config), believed_(target), time_s_(time_s) {}

  bool searching() const { return region_.has_value(); }
  const std::optional<Region>& region() const { return region_; }
  // The target as last believed in, brought to the newest frame.
  const Particle& believed() const { return believed_; }
  // How far what is followed is the designated target, and not another like it.
  double identity() const { return identity_; }

  // The target is followed: what was believed in is forgotten.
  void restart(const Particle& target);
  // It was seen where it is believed to be.
  void see(const Particle& target) { believed_ = target; }
  // It is believed in: the search is over.
  void end();
  // It is lost: `sd_px` is how far it may be from where it is expected.
  void start(double sd_px);
  // It is told to be near `pixel`.
  void start_near(const Eigen::Vector2d& pixel, double sd_px);

  // Velocities against the scene change by this.
  void change_velocity(const Eigen::Vector2d& change_px_s) {
    believed_.velocity_px_s += change_px_s;
  }
  // Brings target and region to the newest frame, unless they were placed there.
  void predict(const MotionModel& motion, const SceneMotion& scene, bool placed);
  // Redraws a share of the particles over the region.
  void scatter(std::vector<Particle>& particles, Random& random) const;
  // Finds what moves, near where the target should be first, then anywhere, and puts a share of the
  // particles there.
  void look_for_movers(const SceneMotion& scene, const Eigen::Vector2d& size_px);
  void force_onto_movers(std::vector<Particle>& particles, Random& random) const;
  Particle drawn_near(const Eigen::Vector2d& pixel, double sd_px, Random& random) const;

  // A distant target that was lost comes back near where it should be, or moving. What stands still
  // against the scene elsewhere is a twig, a window or a reticle, however much it looks like it.
  bool may_be_it(const Particle& particle) const;
  // What is found elsewhere is one of all that move and look like the target, or of those that are
  // out of sight: nobody can tell which.
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
  double believed_identity_ = 1.0;  // of what was last believed in
  double identity_ = 1.0;
  double time_s_;
  double unaligned_since_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace ols::tracker
