#include "edge/tracker/paper_template.h"

#include <algorithm>
#include <cmath>

#include "edge/tracker/objective.h"

namespace ols::tracker {

double paper_objective(const Patch& template_gray, const MaskPatch& template_mask,
                       const Patch& candidate_gray, const MaskPatch& candidate_mask) {
  const auto& exponential = exponentials<double>();
  double sum = 0.0;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const double alike =
        1.0 - std::abs(static_cast<double>(template_gray[i] - candidate_gray[i])) / 255.0;
    sum += exponential[std::min(template_mask[i], candidate_mask[i])] * alike * alike;  // eq. (5)
  }
  return sum;
}

// "The target is represented as a rectangular template (consisting of gray-scale intensity values),
// which is normalized to the size 24x24 pixels." "The template is created only once during the
// initialization."
PaperTemplate::PaperTemplate(const TrackerInput& frame, const cv::Rect2d& box)
    : first_{frame.gray.clone(), Eigen::Matrix3d::Identity(), box, frame.time_s},
      appearance_(make_template(whole(frame.gray), centre_of(box), size_of(box))) {}

void PaperTemplate::follow(const SceneMotion& scene) {
  if (scene.alignment_lost()) first_.gray.release();  // it can no longer be aligned
  if (scene.homography()) first_.to_present = *scene.homography() * first_.to_present;
}

// "The FM Mt is estimated only once": the template's frame minus the first later one in which the
// target has left its box.
void PaperTemplate::estimate_mask(const cv::Mat& gray, double time_s, const Particle& target) {
  if (mask_) return;
  if (first_.gray.empty() || !aligns(first_.to_present)) {
    // The alignment with the template's frame is lost: start again with the present frame.
    first_ = {gray.clone(), Eigen::Matrix3d::Identity(), box_of(target.pixel, target.size_px),
              time_s};
    return;
  }
  const Eigen::Matrix3d to_first = first_.to_present.inverse();
  const cv::Rect2d there = box_of(transform(to_first, target.pixel), target.size_px);
  const cv::Rect2d& here = first_.target_box;
  if ((there & here).area() > 0.0) return;
  const ReferenceFrames::Reference present{gray, to_first, {}, time_s};
  const FrameView mask = foreground_mask(first_.gray, present, enclosing(here), appearance_);
  mask_ = sample_mask(mask, centre_of(here), size_of(here));
  first_.gray.release();
}

double PaperTemplate::greatest_objective() const {
  if (!mask_) return kPatchArea;
  double greatest = 0.0;
  for (const std::uint8_t mask : *mask_) greatest += exponentials<double>()[mask];
  return greatest;
}

}  // namespace ols::tracker
