#include "tools/calibrate/board_fit.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "tools/calibrate/radial_board_fit.h"

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kLeastViews = 5;
constexpr Index kOwn = 9;   // fx, fy, cx, cy, k1, k2, p1, p2, k3
constexpr Index kPose = 6;  // of a board
constexpr int kDistortions = 5;

// The normal equations of the camera's nine parameters, with every board's pose eliminated.
MatrixXd reduced(const std::vector<BoardView>& views, const cv::Mat& K, const cv::Mat& distortion,
                 const std::vector<cv::Mat>& turns, const std::vector<cv::Mat>& shifts) {
  MatrixXd N = MatrixXd::Zero(kOwn, kOwn);
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<cv::Point2f> image;
    cv::Mat jacobian;
    cv::projectPoints(views[i].board, turns[i], shifts[i], K, distortion, image, jacobian);
    MatrixXd J(jacobian.rows, kPose + kOwn);
    for (int row = 0; row < jacobian.rows; ++row) {
      for (int column = 0; column < kPose + kOwn; ++column) {
        J(row, column) = jacobian.at<double>(row, column);
      }
    }
    const auto pose = J.leftCols(kPose);
    const auto own = J.rightCols(kOwn);
    const MatrixXd cross = pose.transpose() * own;
    N += own.transpose() * own - cross.transpose() * (pose.transpose() * pose).ldlt().solve(cross);
  }
  return N;
}

}  // namespace

BoardCamera fit_boards(const std::vector<BoardView>& views, const cv::Size& picture,
                       LensModel model) {
  if (views.size() < kLeastViews) {
    throw std::invalid_argument("the board is found in " + std::to_string(views.size()) +
                                " pictures, 5 are needed at least");
  }
  if (model != LensModel::kPinhole) return fit_boards_radially(views, picture, model);
  std::vector<std::vector<cv::Point3f>> boards;
  std::vector<std::vector<cv::Point2f>> pixels;
  double corners = 0.0;
  for (const BoardView& view : views) {
    boards.push_back(view.board);
    pixels.push_back(view.pixels);
    corners += static_cast<double>(view.pixels.size());
  }
  cv::Mat K, distortion, deviations, pose_deviations, view_rms;
  std::vector<cv::Mat> turns, shifts;
  BoardCamera result;
  result.rms_px = cv::calibrateCamera(boards, pixels, picture, K, distortion, turns, shifts,
                                      deviations, pose_deviations, view_rms);
  const double fx = K.at<double>(0, 0), fy = K.at<double>(1, 1);
  const double degrees_of_freedom = 2.0 * corners - static_cast<double>(kOwn) -
                                    static_cast<double>(kPose) * static_cast<double>(views.size());
  const double variance = corners * result.rms_px * result.rms_px / degrees_of_freedom;
  const MatrixXd N = reduced(views, K, distortion, turns, shifts);
  const auto solver = N.ldlt();
  const MatrixXd C = variance * solver.solve(MatrixXd::Identity(kOwn, kOwn));
  if (!(fx > 0.0 && fy > 0.0) || !(degrees_of_freedom > 0.0) || !C.allFinite() ||
      !solver.isPositive()) {
    throw std::invalid_argument("the pictures leave the camera undetermined: tilt the board");
  }
  // From fx, fy to the focal length and the aspect.
  Eigen::Matrix<double, kCameraSize, kOwn> A = Eigen::Matrix<double, kCameraSize, kOwn>::Identity();
  A(1, 0) = -fy / (fx * fx);
  A(1, 1) = 1.0 / fx;
  result.covariance = A * C * A.transpose();
  result.values << fx, fy / fx, K.at<double>(0, 2), K.at<double>(1, 2), 0.0, 0.0, 0.0, 0.0, 0.0,
      0.0;
  for (int k = 0; k < kDistortions; ++k) result.values[4 + k] = distortion.at<double>(k);
  for (int i = 0; i < view_rms.rows; ++i) result.view_rms_px.push_back(view_rms.at<double>(i));
  return result;
}

}  // namespace ols::calibration
