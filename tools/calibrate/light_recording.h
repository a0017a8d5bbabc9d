// Reads the brightness of a blinking light from an event that a station has recorded
// (edge/recorder/event_folder.h).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/light_fit.h"

namespace ols::calibration {

struct LightRecording {
  std::vector<LightSample> samples;
  bool by_arrival = false;                          // the times are by arrival
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // where the light is
};

// Finds the pixel that blinks most clearly with the light's period. The camera must rest.
// `row_readout_s`: as in camera::Frame. Throws CsvError and std::runtime_error naming file and
// line.
LightRecording read_light(const std::string& folder, const BlinkingLight& light,
                          double row_readout_s);

}  // namespace ols::calibration
