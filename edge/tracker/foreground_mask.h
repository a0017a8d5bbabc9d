// Foreground masks: what differs from an earlier, aligned image in which the target was elsewhere.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>

#include "edge/tracker/patch.h"

namespace ols::tracker {

// Earlier frames, each with the homography that brings it to the present one.
class ReferenceFrames {
 public:
  explicit ReferenceFrames(double interval_s) : interval_s_(interval_s) {}

  void clear() { references_.clear(); }
  // The camera has moved: previous frame's pixels to this frame's.
  void advance(const Eigen::Matrix3d& homography);
  // Keeps a copy of this frame when the newest is old enough.
  void offer(const cv::Mat& gray, double time_s, const cv::Rect2d& target_box);

  // The newest frame whose target would not overlap `target_box` of the present frame.
  struct Reference {
    cv::Mat gray;
    Eigen::Matrix3d to_present = Eigen::Matrix3d::Identity();
    cv::Rect2d target_box;  // in the reference
    double time_s = 0.0;
  };
  // The newest that is so old; nothing when there is none.
  const Reference* older_than(double time_s) const;
  const Reference* without_overlap(const cv::Rect2d& target_box) const;

 private:
  double interval_s_;
  std::deque<Reference> references_;
};

// Where no earlier image shows the background alone: |frame - `level`|, the grey level around the
// target. Against a sky that is the same thing.
FrameView foreground_mask(const cv::Mat& frame, double level, const cv::Rect& area,
                          const Template& target);

// |frame - reference| inside `area` of the frame, 0..255 as 0..1 of foreground: `noise` grey levels
// are nothing, half of `contrast` is certain.
FrameView foreground_mask(const cv::Mat& frame, const ReferenceFrames::Reference& reference,
                          const cv::Rect& area, const Template& target);

}  // namespace ols::tracker
