// The corners of a calibration board in a picture: chessboard, ChArUco or a grid of AprilTags.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "tools/calibrate/board_fit.h"

namespace ols::calibration {

struct BoardShape {
  std::string kind = "chessboard";  // "charuco", "apriltag"
  // Inner corners of a chessboard, squares of a ChArUco, tags of a grid.
  int columns = 0, rows = 0;
  // Edge of a square; of a grid of tags from one tag to the next. Edge of a marker or tag.
  double square_m = 0.025, marker_m = 0.0;
};

// std::invalid_argument naming the option, for shapes that cannot be used.
void check_board(const BoardShape& shape);

// No corners: the board is not found, or too little of it. Of a chessboard all corners are needed;
// of a ChArUco (dictionary 5X5_1000) eight; of AprilTags (36h11, numbered row by row from 0, from
// the top or from the bottom) four tags.
BoardView find_board(const cv::Mat& picture, const BoardShape& shape);

}  // namespace ols::calibration
