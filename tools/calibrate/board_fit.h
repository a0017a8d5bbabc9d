// Fits a camera in one of the lens models (geometry/lens.h) to pictures of a flat board, with its
// full covariance. Only for cameras that can focus at the board: in the picture of a long lens
// focused at infinity, the board is only a blur.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "geometry/lens.h"

namespace ols::calibration {

// The corners in one picture, and the position [m] of each of them on the board.
struct BoardView {
  std::vector<cv::Point3f> board;
  std::vector<cv::Point2f> pixels;
};

// The order of the parameters in every vector and covariance. Parameters that a lens model does not
// have are exactly zero.
inline constexpr std::array<const char*, 10> kCameraParameters{
    "focal_px", "aspect", "cx_px", "cy_px", "k1", "k2", "p1", "p2", "k3", "k4"};
inline constexpr int kCameraSize = static_cast<int>(kCameraParameters.size());

struct BoardCamera {
  using Vector = Eigen::Matrix<double, kCameraSize, 1>;
  using Matrix = Eigen::Matrix<double, kCameraSize, kCameraSize>;
  Vector values = Vector::Zero();
  Matrix covariance = Matrix::Zero();  // scaled by the residuals
  double rms_px = 0.0;                 // RMS distance of a corner, as OpenCV defines it
  std::vector<double> view_rms_px;
};

// Throws std::invalid_argument for fewer than five views, or views that do not determine the
// camera.
BoardCamera fit_boards(const std::vector<BoardView>& views, const cv::Size& picture,
                       LensModel model = LensModel::kPinhole);

}  // namespace ols::calibration
