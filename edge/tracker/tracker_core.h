// The tracker once it has a target: one step of the paper's section 5 a frame. Input is checked by
// the facade, tracker.h.
#pragma once

#include <limits>

#include "edge/tracker/belief.h"
#include "edge/tracker/ego_motion.h"
#include "edge/tracker/mover_detection.h"
#include "edge/tracker/particle_filter.h"
#include "edge/tracker/stage_times.h"
#include "edge/tracker/target_model.h"
#include "edge/tracker/target_tracker.h"

namespace ols {

class TrackerCore {
 public:
  TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
              const cv::Rect2d& box);

  TrackerOutput step(const TrackerInput& frame, StageTimer& timer);
  void search_near(const Eigen::Vector2d& pixel, double sd_px);
  const std::optional<Eigen::Matrix3d>& image_homography() const { return image_homography_; }

 private:
  // Where the target is looked for while it is not believed in; the present frame's pixels.
  struct Search {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double sd_px = 0.0;
    double most_sd_px = 0.0;
    double since_s = 0.0;
    bool told = false;  // by search_near(): it is there whether it moves or not
  };
  // The designated box about what stands out in it, both in that part's sizes.
  struct Label {
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of its centre, from that part's
    Eigen::Vector2d scale = Eigen::Vector2d::Ones();
  };
  enum class Velocity { kEstimated, kUnknown };

  EgoMotion move_camera(const TrackerInput& frame, const ReducedFrame& reduced, double interval_s);
  void predict(EgoMotion ego_motion, const ReducedFrame& reduced, double interval_s,
               StageTimer& timer);
  void move_half_by_other();
  void predict_search(double interval_s);
  void guess_velocities();
  void force_onto_differences(const ReducedFrame& reduced, const cv::Rect2d& area);
  void find_movers(const ReducedFrame& reduced);
  void force_onto_movers();
  bool may_be_it(const Particle& particle) const;
  void designate_late(const cv::Mat& gray);
  cv::Rect2d reachable_area(double interval_s) const;
  void scatter_over_search(double fraction);
  TrackerOutput update(const TrackerInput& frame, double interval_s, StageTimer& timer);
  TrackerOutput locate(const Scene& scene, std::size_t best, double interval_s);
  RefinedPosition measure(const Scene& scene, const RefinedPosition& placed);
  void propose_usual_size();
  void learn_shared_noise(double shared_noise, double interval_s);
  void forget_measured();
  void weigh_particles(const Scene& scene, double background);
  std::size_t choose(const Scene& scene, double background, double interval_s) const;
  FrameEvidence evidence_of(const Scene& scene, const Particle& particle, double background) const;
  void judge(const Scene& scene, double background, double interval_s);
  double identity_of_found(const Scene& scene, double background) const;
  bool near_prediction(const Particle& particle) const;
  bool looks_near_first() const;
  double first_reach_px(double interval_s) const;
  void start_search(double interval_s);
  bool beyond_reach(const Eigen::Vector2d& pixel, double interval_s) const;
  bool scene_unknown() const;  // nothing shows what was there a moment ago
  void after_update(const TrackerOutput& output, double interval_s);
  Particle drawn_near(const Eigen::Vector2d& pixel, double sd_px);

  TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
              const cv::Rect2d& box, const cv::Rect2d& core);
  Eigen::Vector2d designated_point(const Particle& particle) const;
  cv::Rect2d labelled(const Particle& particle) const;

  TrackerConfig config_;
  Random random_;
  EgoMotionEstimator ego_motion_;
  ReducedFrame reduced_;
  MotionModel motion_;
  ParticleFilter filter_;
  TargetModel target_;
  ReferenceFrames references_;
  Belief belief_;
  // How far what was last believed in is the designated target, and not another like it; and what
  // is followed now.
  double believed_identity_ = 1.0, identity_ = 1.0;
  std::optional<Search> search_;
  bool placed_ = false;  // the particles stand in the coming frame already
  double scene_since_s_ =
      -std::numeric_limits<double>::infinity();  // when the camera's motion was lost: what is seen
                                                 // is another scene
  bool scene_lost_ = false;  // it was followed up to the frame before: this may be a cut
  Velocity velocity_ = Velocity::kUnknown;
  Label label_;
  Particle last_;  // best estimate in the newest frame
  // Of the first image in the newest frame: the box is of what has been learnt since, too.
  std::optional<Eigen::Vector2d> measured_size_px_;
  int shared_noise_count_ = 0;
  double shared_noise_ = 1.0;           // RefinedPosition's, of late
  std::vector<MoverCandidate> movers_;  // of this frame, while the target is looked for
  Particle believed_;                   // the last one seen, brought to the newest frame
  std::optional<Eigen::Matrix3d> image_homography_;
  // By the mount's homography from where the image's takes the target, where the two disagree.
  std::optional<Eigen::Vector2d> other_step_px_;
  std::vector<double> log_likelihood_;  // memory that is used again
  double empty_s_ = 0.0;
  cv::Rect2d designated_;  // the box while there is nothing in it, the present frame's pixels
  cv::Size frame_size_;
  double time_s_ = 0.0;
};

}  // namespace ols
