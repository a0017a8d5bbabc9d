// Models the target's appearance, and evaluates particles with it.
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

// A frame that is prepared for the objective function.
struct Scene {
  FrameView whole;   // the original frame
  FrameView view;    // reduced according to the target's size
  FrameView smooth;  // candidates are sampled from this one
  FrameView mask;    // the foreground
  // The mask was made by comparison with an earlier image. Otherwise, it was made by comparison
  // with the grey level of the surroundings.
  bool mask_by_subtraction = false;
  double background_similarity = 0.0;  // TargetModel::background_similarity() of this frame
  LocalContrast contrast;
  cv::Size frame;
};

class TargetModel {
 public:
  TargetModel(const TrackerConfig& config, const cv::Mat& gray, const cv::Rect2d& box);

  // `particles`: the places that will be evaluated. `expected`: the box in which the target is
  // expected.
  Scene make_scene(const cv::Mat& gray, const std::vector<Particle>& particles,
                   const cv::Rect2d& expected, const ReferenceFrames& references) const;

  Similarity likeness(const Scene& scene, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px) const;
  // The similarity that background reaches by chance: the 75 % quantile over boxes around `box`,
  // which do not contain the target.
  double background_similarity(const Scene& scene, const cv::Rect2d& box) const;
  // The contrast of a place with its surroundings, relative to the target's usual contrast.
  double standing_out(const Scene& scene, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px) const;
  // Share of the target's foreground that is foreground at this place.
  double foreground(const Scene& scene, const Eigen::Vector2d& pixel,
                    const Eigen::Vector2d& size_px) const;
  // A log-likelihood from four parts: the similarity relative to the background's, the correlation,
  // the contrast, and the prior of the size.
  double log_likelihood(const Similarity& likeness, double background, double standing_out,
                        const Eigen::Vector2d& size_px) const;

  // The evidence for a candidate in the scene.
  FrameEvidence evidence(const Scene& scene, const Particle& candidate) const;

  // Learns the target's present appearance and contrast with this weight.
  void learn(const Scene& scene, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px,
             double share);

  // Learns the target's present size, from a sharp image.
  void learn_size(const Eigen::Vector2d& size_px, double share);

  // Returns the size of a visible target, and lets the ScaleFilter learn the images of this size.
  // If the size was `measured` by comparison with the first image, the size of `target` is
  // returned. Otherwise, the usual size is corrected by the growth of the present appearance
  // (ScaleFilter).
  Eigen::Vector2d follow_size(const cv::Mat& gray, const Particle& target,
                              const std::optional<Eigen::Vector2d>& measured, double interval_s);
  // Call when the tracker returns to the target after it has followed another object. `size_px`:
  // the target's size before that.
  void restart_size(const Eigen::Vector2d& size_px);

  // Learns the target's foreground mask, M_t of eq. (5), once: the foreground of a candidate that
  // is certainly the target.
  void learn_mask(const Scene& scene, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px);

  // The best fit of a box of this size. The error of `start` may be up to about a third of the
  // target's size.
  std::optional<RefinedPosition> place(const Scene& scene, const Eigen::Vector2d& start,
                                       const Eigen::Vector2d& size_px) const {
    return refiner_.refine(scene.view, start, size_px);
  }
  // Refines `placed`, the result of place(): sub-pixel position and size at full resolution.
  std::optional<RefinedPosition> measure(const Scene& scene, const RefinedPosition& placed,
                                         const Eigen::Vector2d& likely_size_px) const;
  const Eigen::Vector2d& usual_size_px() const { return usual_size_px_; }
  // Whether nothing was conspicuous in the first box, so that there is nothing to recognise.
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
  // Works in the original frame; exists only if the target's view is reduced.
  std::optional<PositionRefiner> fine_refiner_;
  MaskPatch mask_{};  // M_t
  bool mask_learnt_ = false;
  double contrast_ = 0.0;         // [grey levels] recent value, relative to its surroundings
  double contrast_weight_ = 0.0;  // 0..1, how far contrast_ exceeds noise
};

}  // namespace ols::tracker
