// The configuration of a camera with a Linux driver (Video4Linux2), for example a USB camera (UVC).
// Pure.
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
  // The time from mid-exposure to the driver's stamp, and its 1-sigma. This time is a constant of
  // the camera. It is often a considerable part of a frame period, because the driver stamps the
  // picture's arrival.
  double delay_s = 0.02, delay_sd_s = 0.02;
  // Time from the exposure of the first row to that of the last row; 0 if all rows are exposed at
  // once.
  double row_readout_s = 0.0;
  double frozen_s = 20.0;  // reopen if the picture has not changed for this time; 0 for never
  // Reopen if no picture has come for this time plus two frame periods.
  double no_frame_timeout_s = 3.0;
  bool keep_raw = false;
  std::string element = "v4l2src";  // GStreamer's source element; tests replace it
};

config::Section v4l2_section(V4l2Config& config);  // the section [camera]

// The description of GStreamer's pipeline. Its source is named "source", its appsink "sink".
std::string v4l2_pipeline(const V4l2Config& config);

}  // namespace ols::camera
