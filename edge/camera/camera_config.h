// What a station knows about its camera before the first frame. Pure.
#pragma once

#include <string>
#include <vector>

#include "base/config/config_section.h"

namespace ols::camera {

// What triggers an exposure.
enum class TriggerMode {
  kFixedRate,  // the camera's own timer, at frame_rate_hz
  kFreeRun,    // the camera itself, as fast as it can
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
  double frame_rate_hz = 15.0;         // with a trigger: the maximum to be expected
  TriggerMode trigger = TriggerMode::kFixedRate;
};

// Whether the camera itself determines the time of an exposure.
bool is_timed(TriggerMode trigger);

// The configuration keys that every kind has: size, format and rate.
std::vector<config::Row> picture_rows(CameraConfig& config);

}  // namespace ols::camera
