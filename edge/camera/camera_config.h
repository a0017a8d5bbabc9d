// The configuration that all kinds of cameras have. Pure.
#pragma once

#include <string>
#include <vector>

#include "base/config/config_section.h"

namespace ols::camera {

// What triggers an exposure.
enum class TriggerMode {
  kFixedRate,  // the camera's own timer, at frame_rate_hz
  kFreeRun,    // the camera itself, at its maximum rate
  kSoftware,   // Camera::trigger()
  kLine1,      // a pulse on one of the camera's lines
  kLine2,
  kLine3,
  kLine4,
};

struct CameraConfig {
  int width_px = 1280;
  int height_px = 960;
  std::string pixel_format = "Mono8";  // Mono8, Bayer{RG,GR,GB,BG}8, RGB8 or BGR8
  double frame_rate_hz = 15.0;         // with a trigger: the maximum rate to expect
  TriggerMode trigger = TriggerMode::kFixedRate;
};

// Whether the camera itself starts its exposures, at regular intervals (kFixedRate, kFreeRun).
bool is_timed(TriggerMode trigger);

// The configuration keys of every kind of camera: size, format and rate.
std::vector<config::Row> picture_rows(CameraConfig& config);

}  // namespace ols::camera
