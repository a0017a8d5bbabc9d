// Finds the corners of a calibration board in a picture: chessboard, ChArUco or a grid of
// AprilTags.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "tools/calibrate/board_fit.h"

namespace ols::calibration {

struct BoardShape {
  std::string kind = "chessboard";  // "charuco", "apriltag"
  // Inner corners of a chessboard, squares of a ChArUco, or tags of a grid.
  int columns = 0, rows = 0;
  // Edge of a square (for a grid: distance from tag to tag); edge of a marker or tag.
  double square_m = 0.025, marker_m = 0.0;
};

// Throws std::invalid_argument naming the option, for unusable shapes.
void check_board(const BoardShape& shape);

// Empty if too little of the board is found. A chessboard needs all corners, a ChArUco (dictionary
// 5X5_1000) eight. AprilTags (36h11) need four tags; they are numbered row by row from 0, from the
// top or from the bottom.
BoardView find_board(const cv::Mat& picture, const BoardShape& shape);

}  // namespace ols::calibration
