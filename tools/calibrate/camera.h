// ols-calibrate camera: the camera part of an instrument, from pictures of a board.
#pragma once

#include <string>
#include <vector>

#include "tools/calibrate/board_detection.h"

namespace ols::calibration {

struct CameraOptions {
  std::vector<std::string> pictures;
  BoardShape shape;
  std::string output;
};

// Writes the folder; returns remarks for a person. Throws std::runtime_error or
// std::invalid_argument naming picture or option.
std::vector<std::string> write_camera(const CameraOptions& options);

}  // namespace ols::calibration
