#include "edge/tracker/foreground_mask.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {
namespace {

constexpr std::size_t kMost = 8;
constexpr double kMostMaskPixels = 60000.0;

cv::Rect2d moved_box(const cv::Rect2d& box, const Eigen::Matrix3d& homography) {
  return box_of(transform(homography, centre_of(box)), size_of(box));
}

cv::Matx33d mask_to_reference(const FrameView& mask, const Eigen::Matrix3d& to_present) {
  Eigen::Matrix3d to_frame = Eigen::Matrix3d::Identity();
  const double offset = (mask.reduction - 1.0) / 2.0;
  to_frame(0, 0) = to_frame(1, 1) = mask.reduction;
  to_frame(0, 2) = mask.origin.x + offset;
  to_frame(1, 2) = mask.origin.y + offset;
  const Eigen::Matrix3d m = to_present.inverse() * to_frame;
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

// The part of the frame, reduced if large: the mask is coarse anyway.
FrameView reduced_part(const cv::Mat& frame, const cv::Rect& area) {
  cv::Rect inside = area & cv::Rect(0, 0, frame.cols, frame.rows);
  if (inside.empty()) return {};
  const int reduction =
      std::max(1, static_cast<int>(std::ceil(std::sqrt(inside.area() / kMostMaskPixels))));
  const cv::Size size(inside.width / reduction, inside.height / reduction);
  if (size.empty()) return {};
  inside.width = size.width * reduction;
  inside.height = size.height * reduction;
  FrameView part{cv::Mat(), inside.tl(), reduction};
  cv::resize(frame(inside), part.image, size, 0, 0, cv::INTER_LINEAR);
  return part;
}

// Grey levels of difference to 0..255.
void scale_to_mask(cv::Mat& difference, const Template& target) {
  const double nothing = 2.0 * static_cast<double>(target.noise);
  const double certain = std::max(nothing + 2.0, 0.5 * static_cast<double>(target.contrast));
  const double gain = 255.0 / (certain - nothing);
  difference.convertTo(difference, CV_8U, gain, -nothing * gain);
}

}  // namespace

void ReferenceFrames::advance(const Eigen::Matrix3d& homography) {
  for (Reference& reference : references_) {
    reference.to_present = homography * reference.to_present;
    reference.to_present /= reference.to_present(2, 2);
  }
  std::erase_if(references_, [](const Reference& r) { return !aligns(r.to_present); });
}

void ReferenceFrames::offer(const cv::Mat& gray, double time_s, const cv::Rect2d& target_box) {
  if (!references_.empty() && time_s - references_.back().time_s < interval_s_) return;
  // Reuses the memory of the oldest: a frame is a megabyte. But the only one that shows the
  // background of a stationary target is kept.
  cv::Mat memory;
  if (references_.size() == kMost) {
    const bool needed = without_overlap(target_box) == &references_.front();
    const auto oldest = references_.begin() + (needed ? 1 : 0);
    memory = oldest->gray;
    references_.erase(oldest);
  }
  gray.copyTo(memory);
  references_.push_back({memory, Eigen::Matrix3d::Identity(), target_box, time_s});
}

const ReferenceFrames::Reference* ReferenceFrames::older_than(double time_s) const {
  for (auto reference = references_.rbegin(); reference != references_.rend(); ++reference) {
    if (reference->time_s <= time_s) return &*reference;
  }
  return nullptr;
}

const ReferenceFrames::Reference* ReferenceFrames::without_overlap(
    const cv::Rect2d& target_box) const {
  // Half a box further, so that a wing, or the blur, of the earlier target is not foreground now.
  const cv::Rect2d wide(target_box.x - 0.5 * target_box.width,
                        target_box.y - 0.5 * target_box.height, 2.0 * target_box.width,
                        2.0 * target_box.height);
  for (auto reference = references_.rbegin(); reference != references_.rend(); ++reference) {
    const cv::Rect2d there = moved_box(wide, reference->to_present.inverse());
    const bool seen = there.x >= 0 && there.y >= 0 && there.br().x <= reference->gray.cols &&
                      there.br().y <= reference->gray.rows;
    if (seen && (there & reference->target_box).area() <= 0.0) return &*reference;
  }
  return nullptr;
}

FrameView foreground_mask(const cv::Mat& frame, double level, const cv::Rect& area,
                          const Template& target) {
  FrameView mask = reduced_part(frame, area);
  if (mask.image.empty()) return mask;
  cv::absdiff(mask.image, cv::Scalar(level), mask.image);
  scale_to_mask(mask.image, target);
  return mask;
}

FrameView foreground_mask(const cv::Mat& frame, const ReferenceFrames::Reference& reference,
                          const cv::Rect& area, const Template& target) {
  FrameView mask = reduced_part(frame, area);
  if (mask.image.empty()) return mask;
  cv::Mat then;
  cv::warpPerspective(reference.gray, then, mask_to_reference(mask, reference.to_present),
                      mask.image.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  // The camera's gain may have changed since.
  const double brighter = cv::mean(mask.image)[0] - cv::mean(then)[0];
  then.convertTo(then, CV_8U, 1.0, brighter);
  cv::absdiff(mask.image, then, mask.image);
  scale_to_mask(mask.image, target);
  return mask;
}

}  // namespace ols::tracker
