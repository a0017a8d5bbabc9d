// Automatic exposure that protects the target's contrast. Pure.
//
// Gray levels are proportional to light until they saturate, and so is the contrast between target
// and surround. So the brighter one of the two is brought to a level just below saturation; what
// the rest of the picture does is of no interest while there is a target. Without one the mean of
// the whole picture is brought to a middle level. Exposure comes before gain, because gain only
// makes noise brighter; the greatest exposure is the limit that motion blur sets.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "edge/camera/exposure.h"

namespace ols::camera {

// Gray levels of a picture, or of a target and its surround.
struct PictureLevels {
  bool target = false;     // of a target, otherwise of the whole picture
  double mean = 0.0;       // of the whole picture; with a target, of its surround
  double bright = 0.0;     // the brighter one's 95 % quantile
  double saturated = 0.0;  // the brighter one's share of pixels at the upper end
};

// `gray` is 8-bit. The surround is the ring around the box, three times its size. A box that has no
// part in the picture is none.
PictureLevels measure_levels(const cv::Mat& gray, const std::optional<cv::Rect2d>& target_box);

struct AutoExposureConfig {
  double bright_level = 200.0;   // gray levels; of the brighter one of target and surround
  double mean_level = 110.0;     // of the picture without a target
  double dead_band = 0.12;       // nothing is changed for less than this share of light
  double damping = 0.7;          // share of a (logarithmic) error that one change takes away
  double greatest_factor = 2.0;  // of one change
  int settle_frames = 4;         // between changes: until a change is to be seen in the frames
};

class AutoExposure {
 public:
  AutoExposure(const AutoExposureConfig& config, const ExposureLimits& limits,
               const ExposureSetting& start);

  // Once a frame; the next setting when it is to be changed. The caller tells the camera, and what
  // the camera made of it by applied().
  std::optional<ExposureSetting> step(const PictureLevels& levels);
  void applied(const ExposureSetting& setting) { setting_ = setting; }

  // How much more (> 1) or less light the picture should have and the limits do not allow.
  double missing_factor() const { return missing_; }

 private:
  double wanted_factor(const PictureLevels& levels) const;
  ExposureSetting split(double light) const;

  AutoExposureConfig config_;
  ExposureLimits limits_;
  ExposureSetting setting_;
  int since_change_;
  double missing_ = 1.0;
};

}  // namespace ols::camera
