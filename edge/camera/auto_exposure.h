// Automatic exposure that protects the target's contrast. Pure.
//
// Gray levels grow with the light until they saturate, and the contrast between target and surround
// grows with them. The exposure therefore brings the brighter of target and surround to a level
// just below saturation, and ignores the rest of the image. Without a target, it brings the mean of
// the whole image to a medium level. The exposure time is raised before the gain, because gain also
// amplifies noise. The exposure time is limited, because a longer one blurs moving objects.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "edge/camera/exposure.h"

namespace ols::camera {

// Gray levels of a target and its surround or, without a target, of the whole image.
struct PictureLevels {
  bool target = false;     // true: the levels are those of a target and its surround
  double mean = 0.0;       // mean of the surround or of the whole image
  double bright = 0.0;     // 95 % quantile; with a target, the larger one of target and surround
  double saturated = 0.0;  // share of saturated pixels; with a target, the larger one
};

// `gray`: 8-bit. The surround is the ring between the target's box and a box of three times its
// width and height. If fewer than nine pixels of target or surround lie in the image, the whole
// image is measured.
PictureLevels measure_levels(const cv::Mat& gray, const std::optional<cv::Rect2d>& target_box);

struct AutoExposureConfig {
  // Desired gray level of the brighter of target and surround.
  double bright_level = 200.0;
  double mean_level = 110.0;  // desired mean of the image if there is no target
  // Smaller errors of the light (natural logarithm of the ratio) are ignored.
  double dead_band = 0.12;
  double damping = 0.7;          // share of the light's logarithmic error that one change corrects
  double greatest_factor = 2.0;  // largest factor of one change
  int settle_frames = 4;  // number of frames to wait after a change until its effect is visible
};

class AutoExposure {
 public:
  AutoExposure(const AutoExposureConfig& config, const ExposureLimits& limits,
               const ExposureSetting& start);

  // Call for each frame. Returns the new setting if a change is needed. The caller then sets the
  // camera and passes the values that the camera has actually taken to applied().
  std::optional<ExposureSetting> step(const PictureLevels& levels);
  void applied(const ExposureSetting& setting) { setting_ = setting; }

  // The factor by which the image should still become brighter when exposure and gain have reached
  // their limits: > 1 if the image remains too dark, < 1 if it remains too bright, 1 if the limits
  // suffice.
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
