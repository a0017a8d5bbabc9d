// The paper's template and its foreground mask; each is made once. Some comments quote the paper.
#pragma once

#include <optional>

#include "edge/tracker/foreground_mask.h"
#include "edge/tracker/scene_motion.h"

namespace ols::tracker {

// Eq. (5): the sum over the patch of exp(min(Mt, Mc)) * (1 - |It - Ic|)^2, with intensities and
// masks in 0..1. It is between 0 and kPatchArea * e.
double paper_objective(const Patch& template_gray, const MaskPatch& template_mask,
                       const Patch& candidate_gray, const MaskPatch& candidate_mask);

// The whole frame as a view: the paper samples its patches from the frame at full resolution.
inline FrameView whole(const cv::Mat& gray) { return {gray, {0, 0}, 1}; }

class PaperTemplate {
 public:
  PaperTemplate(const TrackerInput& frame, const cv::Rect2d& box);

  // Takes the newest frame's ego-motion.
  void follow(const SceneMotion& scene);
  // Makes the mask as soon as a frame shows the background behind the template. `target`: the
  // target's present position.
  void estimate_mask(const cv::Mat& gray, double time_s, const Particle& target);

  const Template& appearance() const { return appearance_; }
  // Eq. (5) for a candidate.
  double objective(const Patch& gray, const MaskPatch& mask) const {
    return paper_objective(appearance_.gray, mask_.value_or(MaskPatch{}), gray, mask);
  }
  double greatest_objective() const;

 private:
  // The frame of the template or, if its alignment was lost, the first frame after the loss. It is
  // used until the mask is made.
  ReferenceFrames::Reference first_;
  Template appearance_;
  std::optional<MaskPatch> mask_;  // M_t
};

}  // namespace ols::tracker
