// ols-calibrate camera: the camera part of an instrument, from pictures of a board.
#pragma once

#include <string>
#include <vector>

#include "tools/calibrate/board_detection.h"
#include "tools/calibrate/command_report.h"

namespace ols::calibration {

struct CameraOptions {
  std::vector<std::string> pictures;
  BoardShape shape;
  LensModel model = LensModel::kPinhole;
  std::string output;
};

// Fits the camera and writes the folder. It is normal that the board is not found in some pictures.
// If it is not found in most pictures, the report says that the description of the board is
// probably wrong. Throws std::runtime_error or std::invalid_argument naming picture or option.
CommandReport write_camera(const CameraOptions& options);

}  // namespace ols::calibration
