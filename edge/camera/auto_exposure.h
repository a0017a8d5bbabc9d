// Automatic exposure that protects the target's contrast. Pure.
//
// Up to saturation, gray levels grow with the light, and so does the contrast between target and
// surround. The exposure therefore brings the brighter of the two to a level just below saturation,
// and ignores the rest of the image. Without a target, the mean of the whole image is brought to a
// middle level. Exposure is raised before gain, because gain also amplifies noise. Motion blur
// limits the exposure.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "edge/camera/exposure.h"

namespace ols::camera {

// Gray levels of an image, or of a target and its surround.
struct PictureLevels {
  bool target = false;     // true: the levels are those of a target; false: of the whole image
  double mean = 0.0;       // of the whole image; if there is a target, of its surround
  double bright = 0.0;     // 95 % quantile of the brighter one of target and surround
  double saturated = 0.0;  // share of saturated pixels in it
};

// `gray`: 8-bit. The surround is the ring around the box, three times its size. A box outside the
// image is ignored.
PictureLevels measure_levels(const cv::Mat& gray, const std::optional<cv::Rect2d>& target_box);

struct AutoExposureConfig {
  // Wanted gray level of the brighter of target and surround.
  double bright_level = 200.0;
  double mean_level = 110.0;     // wanted mean of the image, if there is no target
  double dead_band = 0.12;       // a smaller relative error of the light is ignored
  double damping = 0.7;          // share of the (logarithmic) error that one change corrects
  double greatest_factor = 2.0;  // largest factor of one change
  int settle_frames = 4;  // number of frames between changes, so that a change becomes visible
};

class AutoExposure {
 public:
  AutoExposure(const AutoExposureConfig& config, const ExposureLimits& limits,
               const ExposureSetting& start);

  // Call for each frame. Returns the next setting if a change is needed. The caller sets the camera
  // and passes the camera's actual values to applied().
  std::optional<ExposureSetting> step(const PictureLevels& levels);
  void applied(const ExposureSetting& setting) { setting_ = setting; }

  // The factor by which the image is too dark (> 1) or too bright (< 1) at the limits of exposure
  // and gain.
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
