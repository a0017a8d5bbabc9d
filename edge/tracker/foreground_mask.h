// Makes foreground masks: differences from an earlier, aligned image in which the target was
// elsewhere.
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
  // Takes the camera's motion: `homography` maps the previous frame's pixels to this frame's.
  void advance(const Eigen::Matrix3d& homography);
  // Stores a copy of this frame if the newest stored one is at least `interval_s` older.
  void offer(const cv::Mat& gray, double time_s, const cv::Rect2d& target_box);

  // An earlier frame.
  struct Reference {
    cv::Mat gray;
    Eigen::Matrix3d to_present = Eigen::Matrix3d::Identity();
    cv::Rect2d target_box;  // the target's box in that frame
    double time_s = 0.0;
  };
  // The newest frame that is not newer than time_s; null if there is none.
  const Reference* older_than(double time_s) const;
  // The newest frame that shows the background behind this box of the present frame: the target was
  // elsewhere in it. Null if there is none.
  const Reference* without_overlap(const cv::Rect2d& target_box) const;

 private:
  double interval_s_;
  std::deque<Reference> references_;
};

// Computes |frame - `level`|, where `level` is the grey level around the target. It is used if no
// earlier image shows the background alone. In front of a plain sky, this function and the next one
// give the same mask.
FrameView foreground_mask(const cv::Mat& frame, double level, const cv::Rect& area,
                          const Template& target);

// Computes |frame - reference| inside `area` of the frame, scaled so that 0..255 mean a foreground
// of 0..1. A difference of twice Template::noise counts as 0; a difference of half of
// Template::contrast counts as 1.
FrameView foreground_mask(const cv::Mat& frame, const ReferenceFrames::Reference& reference,
                          const cv::Rect& area, const Template& target);

}  // namespace ols::tracker
