// The tracker of the paper's section 5 and nothing else: mode = "paper". Comments quote the paper.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/ego_motion.h"
#include "edge/tracker/foreground_mask.h"
#include "edge/tracker/random.h"
#include "edge/tracker/stage_times.h"
#include "edge/tracker/target_tracker.h"

namespace ols {

// Eq. (5): the sum over the patch of exp(min(Mt, Mc)) * (1 - |It - Ic|)^2, intensities and masks
// being 0..1. Between 0 and kPatchArea * e.
double paper_objective(const Patch& template_gray, const MaskPatch& template_mask,
                       const Patch& candidate_gray, const MaskPatch& candidate_mask);

class PaperTracker {
 public:
  PaperTracker(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
               const cv::Rect2d& box);
  TrackerOutput step(const TrackerInput& frame, StageTimer& timer);
  const std::optional<Eigen::Matrix3d>& image_homography() const { return homography_; }
  // The paper's operator marks the target again; here the particles go where it is said to be.
  void search_near(const Eigen::Vector2d& pixel, double sd_px);

 private:
  EgoMotion transform_by_homography(const ReducedFrame& reduced);
  void predict(double interval_s);
  void force_subset_onto_differences(const ReducedFrame& reduced);
  void weigh(const cv::Mat& gray);
  void normalise_weights();
  void estimate_template_mask(const cv::Mat& gray, const cv::Rect2d& box);
  const Particle& maximum_a_posteriori() const;
  TrackerOutput output_of(const Particle& best) const;
  void resample();
  Eigen::Vector2d noise(double sd);

  TrackerConfig config_;
  Random random_;
  EgoMotionEstimator ego_motion_;
  ReducedFrame reduced_;
  ReferenceFrames references_;
  // The template's frame, or the first one since its alignment was lost, until the template's mask
  // is made.
  ReferenceFrames::Reference first_;
  Template template_;
  std::optional<MaskPatch> template_mask_;  // Mt
  std::vector<Particle> particles_;
  std::vector<Particle> resampled_;
  std::vector<double> weights_;
  double greatest_objective_ = 0.0;  // eq. (5) of the best particle
  bool placed_ = false;              // the particles stand in the coming frame already
  Particle last_;
  std::optional<Eigen::Matrix3d> homography_;  // previous frame to this one
  cv::Size frame_size_;
  double time_s_;
};

}  // namespace ols
