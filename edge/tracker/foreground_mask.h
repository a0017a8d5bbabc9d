// Foreground masks: differences from an earlier, aligned image in which the target was elsewhere.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>

#include "edge/tracker/patch.h"

namespace ols::tracker {

// Earlier frames, each with its homography to the present one.
class ReferenceFrames {
 public:
  explicit ReferenceFrames(double interval_s) : interval_s_(interval_s) {}

  void clear() { references_.clear(); }
  // The camera has moved: maps the previous frame's pixels to this frame's.
  void advance(const Eigen::Matrix3d& homography);
  // Keeps a copy of this frame if the newest copy is old enough.
  void offer(const cv::Mat& gray, double time_s, const cv::Rect2d& target_box);

  // The newest frame whose target does not overlap `target_box` of the present frame.
  struct Reference {
    cv::Mat gray;
    Eigen::Matrix3d to_present = Eigen::Matrix3d::Identity();
    cv::Rect2d target_box;  // in the reference
    double time_s = 0.0;
  };
  // The newest copy of at least this age; empty: none.
  const Reference* older_than(double time_s) const;
  const Reference* without_overlap(const cv::Rect2d& target_box) const;

 private:
  double interval_s_;
  std::deque<Reference> references_;
};

// If no earlier image shows the background alone: |frame - `level`|, with the grey level around the
// target. Equivalent in front of a sky.
FrameView foreground_mask(const cv::Mat& frame, double level, const cv::Rect& area,
                          const Template& target);

// |frame - reference| inside `area` of the frame, 0..255 for a foreground of 0..1. `noise` grey
// levels count as 0, half of `contrast` as 1.
FrameView foreground_mask(const cv::Mat& frame, const ReferenceFrames::Reference& reference,
                          const cv::Rect& area, const Template& target);

}  // namespace ols::tracker
