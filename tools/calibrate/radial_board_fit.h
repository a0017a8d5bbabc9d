// Fits a fisheye or polynomial lens (geometry/lens.h) to pictures of a flat board.
#pragma once

#include "geometry/lens.h"
#include "tools/calibrate/board_fit.h"

namespace ols::calibration {

// As fit_boards(), which checks the number of views.
BoardCamera fit_boards_radially(const std::vector<BoardView>& views, const cv::Size& picture,
                                LensModel model);

}  // namespace ols::calibration
