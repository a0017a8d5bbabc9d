// Everything that is known of how the target looks, and the judging of particles by it.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/belief.h"
#include "edge/tracker/foreground_mask.h"
#include "edge/tracker/local_contrast.h"
#include "edge/tracker/objective.h"
#include "edge/tracker/refinement.h"
#include "edge/tracker/tracker_config.h"

namespace ols::tracker {

// One frame as the objective sees it.
struct Scene {
  FrameView whole;                     // the frame as taken
  FrameView view;                      // reduced to the target's size
  FrameView smooth;                    // sampled for the candidates
  FrameView mask;                      // foreground
  bool mask_by_subtraction = false;    // of an earlier image, not of the surroundings' level
  double background_similarity = 0.0;  // what TargetModel::background_similarity() gives for it
  LocalContrast contrast;
  cv::Size frame;
};

class TargetModel {
 public:
  TargetModel(const TrackerConfig& config, const cv::Mat& gray, const cv::Rect2d& box);

  // `particles` say where it will be looked at; `expected` is where the target should be.
  Scene make_scene(const cv::Mat& gray, const std::vector<Particle>& particles,
                   const cv::Rect2d& expected, const ReferenceFrames& references) const;

  Similarity likeness(const Scene& scene, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px) const;
  // What boxes around `box` reach that are not the target: nearly the best of them.
  double background_similarity(const Scene& scene, const cv::Rect2d& box) const;
  // How far a place stands out of its surroundings, the target's usual way being 1.
  double standing_out(const Scene& scene, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px) const;
  // Share of the target's foreground that is foreground here.
  double foreground(const Scene& scene, const Eigen::Vector2d& pixel,
                    const Eigen::Vector2d& size_px) const;
  // Logarithm of a likelihood: similarity against the background's, correlation, how it stands out,
  // and the size's prior.
  double log_likelihood(const Similarity& likeness, double background, double standing_out,
                        const Eigen::Vector2d& size_px) const;

  // What the scene says for a candidate.
  FrameEvidence evidence(const Scene& scene, const Particle& candidate) const;

  // The target's look and contrast of now, taken in by this share.
  void learn(const Scene& scene, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px,
             double share);

  // The size that it has now, as an image showed it well.
  void learn_size(const Eigen::Vector2d& size_px, double share);

  // M_t, once: the candidate's foreground while it is surely the target.
  void learn_mask(const Scene& scene, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px);

  // Where the box of this size fits best, from a start within about a third of the target.
  std::optional<RefinedPosition> place(const Scene& scene, const Eigen::Vector2d& start,
                                       const Eigen::Vector2d& size_px) const {
    return refiner_.refine(scene.view, start, size_px);
  }
  // From there the sub-pixel position, with the size and from all that the frame shows.
  std::optional<RefinedPosition> measure(const Scene& scene, const RefinedPosition& placed,
                                         const Eigen::Vector2d& likely_size_px) const;
  const Eigen::Vector2d& usual_size_px() const { return usual_size_px_; }
  // Nothing stood out in the first box: there is nothing to recognise.
  bool empty() const { return template_.empty; }

 private:
  TargetModel(const TrackerConfig& config, const FrameView& view, const cv::Rect2d& box);

  void set_contrast(double contrast);

  TrackerConfig config_;
  Eigen::Vector2d first_size_px_;
  Eigen::Vector2d usual_size_px_;  // of late
  Template template_;
  Objective objective_;
  PositionRefiner refiner_;
  std::optional<PositionRefiner> fine_refiner_;  // of a reduced target, in the frame as taken
  MaskPatch mask_{};                             // M_t
  bool mask_learnt_ = false;
  double contrast_ = 0.0;         // [grey levels] of late, against its surroundings
  double contrast_weight_ = 0.0;  // 0..1, how much more than noise that is
};

}  // namespace ols::tracker
