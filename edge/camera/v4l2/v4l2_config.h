// The configuration of a camera that Linux drives (Video4Linux2; USB cameras by UVC). Pure.
#pragma once

#include <string>

#include "base/config/config_section.h"
#include "edge/camera/camera_config.h"

namespace ols::camera {

enum class V4l2Format { kRaw, kMjpeg };

struct V4l2Config : CameraConfig {
  std::string device;  // "/dev/v4l/by-id/..."
  V4l2Format format = V4l2Format::kMjpeg;
  std::string controls;  // "exposure_auto=1,exposure_time_absolute=50"
  // From mid-exposure to the driver's stamp: a constant of the camera, often a part of a frame
  // period, because the stamp is that of the picture's arrival.
  double delay_s = 0.02, delay_sd_s = 0.02;
  double row_readout_s = 0.0;  // from the first to the last row of a picture; 0: all rows at once
  double frozen_s = 20.0;      // reopened after the same picture for this time; 0: never
  double no_frame_timeout_s = 3.0;  // reopened after this time without a picture
  bool keep_raw = false;
  std::string element = "v4l2src";  // GStreamer's source; tests put another in its place
};

config::Section v4l2_section(V4l2Config& config);  // the section [camera]

// GStreamer's pipeline from the source, which is named "source", to an appsink named "sink".
std::string v4l2_pipeline(const V4l2Config& config);

}  // namespace ols::camera
