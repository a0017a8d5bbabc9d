// The target's appearance, and the evaluation of particles by it.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/belief.h"
#include "edge/tracker/foreground_mask.h"
#include "edge/tracker/local_contrast.h"
#include "edge/tracker/objective.h"
#include "edge/tracker/refinement.h"
#include "edge/tracker/scale_filter.h"
#include "edge/tracker/tracker_config.h"

namespace ols::tracker {

// One frame, prepared for the objective function.
struct Scene {
  FrameView whole;                   // the original frame
  FrameView view;                    // reduced to the target's size
  FrameView smooth;                  // sampled for the candidates
  FrameView mask;                    // foreground
  bool mask_by_subtraction = false;  // from an earlier image, not from the surroundings' grey level
  double background_similarity = 0.0;  // TargetModel::background_similarity() of this frame
  LocalContrast contrast;
  cv::Size frame;
};

class TargetModel {
 public:
  TargetModel(const TrackerConfig& config, const cv::Mat& gray, const cv::Rect2d& box);

  // `particles`: the places to evaluate. `expected`: the target's expected place.
  Scene make_scene(const cv::Mat& gray, const std::vector<Particle>& particles,
                   const cv::Rect2d& expected, const ReferenceFrames& references) const;

  Similarity likeness(const Scene& scene, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px) const;
  // A high quantile of the similarity of boxes around `box` that are not the target.
  double background_similarity(const Scene& scene, const cv::Rect2d& box) const;
  // The contrast of a place with its surroundings, relative to the target's usual one.
  double standing_out(const Scene& scene, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px) const;
  // Share of the target's foreground that is foreground here.
  double foreground(const Scene& scene, const Eigen::Vector2d& pixel,
                    const Eigen::Vector2d& size_px) const;
  // A log-likelihood from the similarity compared with the background's, the correlation, the
  // contrast, and the prior of the size.
  double log_likelihood(const Similarity& likeness, double background, double standing_out,
                        const Eigen::Vector2d& size_px) const;

  // The evidence of the scene for a candidate.
  FrameEvidence evidence(const Scene& scene, const Particle& candidate) const;

  // Learns the target's present appearance and contrast with this weight.
  void learn(const Scene& scene, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px,
             double share);

  // Learns the target's present size, from a sharp image.
  void learn_size(const Eigen::Vector2d& size_px, double share);

  // The size of the visible target: the size of `target` if it was `measured` by the first image;
  // otherwise the last size, grown as its present appearance has grown.
  Eigen::Vector2d follow_size(const cv::Mat& gray, const Particle& target,
                              const std::optional<Eigen::Vector2d>& measured, double interval_s);
  // What was followed since the target had this size was another object.
  void restart_size(const Eigen::Vector2d& size_px);

  // Learns M_t, once: the candidate's foreground while it is certainly the target.
  void learn_mask(const Scene& scene, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px);

  // The best fit of a box of this size, from a start within about a third of the target.
  std::optional<RefinedPosition> place(const Scene& scene, const Eigen::Vector2d& start,
                                       const Eigen::Vector2d& size_px) const {
    return refiner_.refine(scene.view, start, size_px);
  }
  // From that fit, the sub-pixel position and size in full resolution.
  std::optional<RefinedPosition> measure(const Scene& scene, const RefinedPosition& placed,
                                         const Eigen::Vector2d& likely_size_px) const;
  const Eigen::Vector2d& usual_size_px() const { return usual_size_px_; }
  // Nothing was conspicuous in the first box: there is nothing to recognise.
  bool empty() const { return template_.empty; }

 private:
  TargetModel(const TrackerConfig& config, const FrameView& view, const cv::Rect2d& box);

  void set_contrast(double contrast);

  TrackerConfig config_;
  Eigen::Vector2d first_size_px_;
  Eigen::Vector2d usual_size_px_;  // recent
  ScaleFilter scale_;
  Template template_;
  Objective objective_;
  PositionRefiner refiner_;
  std::optional<PositionRefiner> fine_refiner_;  // of a reduced target, in the original frame
  MaskPatch mask_{};                             // M_t
  bool mask_learnt_ = false;
  double contrast_ = 0.0;         // [grey levels] recent, against its surroundings
  double contrast_weight_ = 0.0;  // 0..1, how far this exceeds noise
};

}  // namespace ols::tracker
