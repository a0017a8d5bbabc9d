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
  // Edge of a square (of a grid: distance from tag to tag), and edge of a marker or tag.
  double square_m = 0.025, marker_m = 0.0;
};

// Throws std::invalid_argument naming the option if the shape is unusable.
void check_board(const BoardShape& shape);

// Finds the board's corners; empty if too few are found. A chessboard needs all corners, a ChArUco
// (dictionary 5X5_1000) needs eight corners, and a grid of AprilTags (36h11) needs four tags. Tags
// are numbered row by row from 0, from the top or from the bottom.
BoardView find_board(const cv::Mat& picture, const BoardShape& shape);

}  // namespace ols::calibration
