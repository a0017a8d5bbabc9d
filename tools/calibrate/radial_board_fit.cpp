#include "tools/calibrate/radial_board_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kOwn = 8;   // fx, fy, cx, cy, k1, k2, k3, k4
constexpr Index kPose = 6;  // of a board: rotation vector, shift
constexpr int kSteps = 50;
constexpr double kConverged_px = 1e-9;  // change of the root mean square

[[noreturn]] void undetermined() {
  throw std::invalid_argument("the pictures leave the camera undetermined: tilt the board");
}

struct Fit {
  CameraIntrinsics camera;
  std::vector<Eigen::Isometry3d> poses;  // camera by board
};

// The first guess of the focal length puts the outermost corner at this angle. OpenCV 4.6 fails
// with its own guess, by which wide pictures reach beyond 90 degrees. Measured: from 50 to 85
// degrees, all guesses end at the same lens.
constexpr double kOutermost_rad = radians(70.0);

double guessed_focal_px(const std::vector<BoardView>& views, const cv::Point2f& middle) {
  double most_px = 0.0;
  for (const BoardView& view : views) {
    for (const cv::Point2f& pixel : view.pixels)
      most_px = std::max(most_px, cv::norm(pixel - middle));
  }
  return most_px / kOutermost_rad;
}

// The camera by OpenCV's fisheye model, and the poses of the boards.
Fit start(const std::vector<BoardView>& views, const cv::Size& picture) {
  std::vector<std::vector<cv::Point3d>> boards;
  std::vector<std::vector<cv::Point2d>> pixels;
  for (const BoardView& view : views) {
    boards.emplace_back(view.board.begin(), view.board.end());
    pixels.emplace_back(view.pixels.begin(), view.pixels.end());
  }
  const cv::Point2f middle(0.5F * static_cast<float>(picture.width - 1),
                           0.5F * static_cast<float>(picture.height - 1));
  const double focal_px = guessed_focal_px(views, middle);
  cv::Matx33d K(focal_px, 0.0, middle.x, 0.0, focal_px, middle.y, 0.0, 0.0, 1.0);
  cv::Vec4d k;
  std::vector<cv::Vec3d> turns, shifts;
  try {
    cv::fisheye::calibrate(boards, pixels, picture, K, k, turns, shifts,
                           cv::fisheye::CALIB_USE_INTRINSIC_GUESS |
                               cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC |
                               cv::fisheye::CALIB_FIX_SKEW);
  } catch (const cv::Exception&) {
    undetermined();
  }
  Fit fit;
  CameraIntrinsics& c = fit.camera;
  c.model = LensModel::kFisheye;
  c.width_px = picture.width, c.height_px = picture.height;
  c.fx_px = K(0, 0), c.fy_px = K(1, 1), c.cx_px = K(0, 2), c.cy_px = K(1, 2);
  c.k1 = k[0], c.k2 = k[1], c.k3 = k[2], c.k4 = k[3];
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Vector3d turn(turns[i][0], turns[i][1], turns[i][2]);
    Eigen::Isometry3d& pose = fit.poses.emplace_back(Eigen::Isometry3d::Identity());
    pose.linear() = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
    pose.translation() << shifts[i][0], shifts[i][1], shifts[i][2];
  }
  return fit;
}

// The polynomial whose radius is nearest to that of a fisheye on the picture.
CameraIntrinsics as_polynomial(const CameraIntrinsics& fisheye) {
  constexpr Index kAngles = 64, kTerms = 5;
  const double most_rad = 0.5 * field_of_view(fisheye).norm();
  MatrixXd A(kAngles, kTerms);
  VectorXd radius(kAngles);
  for (Index i = 0; i < kAngles; ++i) {
    const double theta = most_rad * static_cast<double>(i + 1) / kAngles;
    const double s = theta * theta;
    for (Index j = 0; j < kTerms; ++j) A(i, j) = std::pow(theta, static_cast<double>(j + 1));
    radius[i] =
        theta * (1.0 + s * (fisheye.k1 + s * (fisheye.k2 + s * (fisheye.k3 + s * fisheye.k4))));
  }
  const VectorXd terms = A.colPivHouseholderQr().solve(radius);
  CameraIntrinsics c = fisheye;
  c.model = LensModel::kPolynomial;
  c.fx_px *= terms[0];
  c.fy_px *= terms[0];
  c.k1 = terms[1] / terms[0], c.k2 = terms[2] / terms[0];
  c.k3 = terms[3] / terms[0], c.k4 = terms[4] / terms[0];
  return c;
}

// The equations of one view: rows of corners, columns of its pose and of the camera's own.
struct Rows {
  MatrixXd J;
  VectorXd residuals;
};

Rows rows_of(const Fit& fit, const BoardView& view, std::size_t index) {
  const CameraIntrinsics& c = fit.camera;
  const auto corners = static_cast<Index>(view.pixels.size());
  Rows rows{MatrixXd(2 * corners, kPose + kOwn), VectorXd(2 * corners)};
  for (Index i = 0; i < corners; ++i) {
    const cv::Point3f& board = view.board[static_cast<std::size_t>(i)];
    const cv::Point2f& seen = view.pixels[static_cast<std::size_t>(i)];
    const Vector3d turned = fit.poses[index].linear() * Vector3d(board.x, board.y, board.z);
    const Vector3d p_cam = turned + fit.poses[index].translation();
    const auto pixel = project(c, p_cam);
    if (!pixel) undetermined();
    const auto by_point = project_jacobian(c, p_cam);
    auto J = rows.J.middleRows<2>(2 * i);
    Eigen::Matrix3d by_turn;  // of a point by a small turn: -[turned]x
    by_turn << 0.0, turned.z(), -turned.y(), -turned.z(), 0.0, turned.x(), turned.y(), -turned.x(),
        0.0;
    J.leftCols<3>() = by_point * by_turn;
    J.middleCols<3>(3) = by_point;
    J.middleCols<2>(kPose) << (pixel->x() - c.cx_px) / c.fx_px, 0.0, 0.0,
        (pixel->y() - c.cy_px) / c.fy_px;
    J.middleCols<2>(kPose + 2).setIdentity();
    J.rightCols<4>() = project_by_coefficients(c, p_cam);
    rows.residuals.segment<2>(2 * i) = Vector2d(seen.x, seen.y) - *pixel;
  }
  return rows;
}

void change_camera(CameraIntrinsics& c, const VectorXd& by) {
  double* const fields[] = {&c.fx_px, &c.fy_px, &c.cx_px, &c.cy_px, &c.k1, &c.k2, &c.k3, &c.k4};
  for (Index k = 0; k < kOwn; ++k) *fields[k] += by[k];
}

// One step of Gauss and Newton, every board's pose eliminated; returns the sum of the squares
// before it, and the normal equations of the camera's own.
struct Step {
  double squares = 0.0;
  MatrixXd N = MatrixXd::Zero(kOwn, kOwn);
};

Step improve(const std::vector<BoardView>& views, Fit& fit) {
  Step step;
  VectorXd b = VectorXd::Zero(kOwn);
  std::vector<Rows> rows;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Rows& one = rows.emplace_back(rows_of(fit, views[i], i));
    const auto pose = one.J.leftCols(kPose);
    const auto own = one.J.rightCols(kOwn);
    const auto solver = (pose.transpose() * pose).eval().ldlt();
    const MatrixXd cross = pose.transpose() * own;
    step.squares += one.residuals.squaredNorm();
    step.N += own.transpose() * own - cross.transpose() * solver.solve(cross);
    b += own.transpose() * one.residuals -
         cross.transpose() * solver.solve(pose.transpose() * one.residuals);
  }
  const VectorXd by = step.N.ldlt().solve(b);
  if (!by.allFinite()) undetermined();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto pose = rows[i].J.leftCols(kPose);
    const VectorXd move =
        (pose.transpose() * pose)
            .ldlt()
            .solve(pose.transpose() * (rows[i].residuals - rows[i].J.rightCols(kOwn) * by));
    const Vector3d turn = move.head<3>();
    fit.poses[i].linear() =
        Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()) * fit.poses[i].linear();
    fit.poses[i].translation() += move.tail<3>();
  }
  change_camera(fit.camera, by);
  return step;
}

double rms_px(double squares, double corners) { return std::sqrt(squares / corners); }

}  // namespace

BoardCamera fit_boards_radially(const std::vector<BoardView>& views, const cv::Size& picture,
                                LensModel model) {
  double corners = 0.0;
  for (const BoardView& view : views) corners += static_cast<double>(view.pixels.size());
  Fit fit = start(views, picture);
  if (model == LensModel::kPolynomial) fit.camera = as_polynomial(fit.camera);
  Step last = improve(views, fit);
  for (int i = 0; i < kSteps; ++i) {
    const Step next = improve(views, fit);
    const double change = rms_px(last.squares, corners) - rms_px(next.squares, corners);
    last = next;
    if (std::abs(change) < kConverged_px) break;
    if (i + 1 == kSteps) undetermined();
  }
  const double degrees_of_freedom = 2.0 * corners - static_cast<double>(kOwn) -
                                    static_cast<double>(kPose) * static_cast<double>(views.size());
  const auto solver = last.N.ldlt();
  const MatrixXd C =
      last.squares / degrees_of_freedom * solver.solve(MatrixXd::Identity(kOwn, kOwn));
  const CameraIntrinsics& c = fit.camera;
  if (!(c.fx_px > 0.0 && c.fy_px > 0.0) || !(degrees_of_freedom > 0.0) || !C.allFinite() ||
      !solver.isPositive()) {
    undetermined();
  }
  BoardCamera result;
  result.rms_px = rms_px(last.squares, corners);
  result.values << c.fx_px, c.fy_px / c.fx_px, c.cx_px, c.cy_px, c.k1, c.k2, 0.0, 0.0, c.k3, c.k4;
  // From fx, fy to the focal length and the aspect; p1 and p2 are none of its.
  Eigen::Matrix<double, kCameraSize, kOwn> A = Eigen::Matrix<double, kCameraSize, kOwn>::Zero();
  A.topLeftCorner<6, 6>().setIdentity();
  A(1, 0) = -c.fy_px / (c.fx_px * c.fx_px);
  A(1, 1) = 1.0 / c.fx_px;
  A.bottomRightCorner<2, 2>().setIdentity();
  result.covariance = A * C * A.transpose();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Rows rows = rows_of(fit, views[i], i);
    result.view_rms_px.push_back(
        rms_px(rows.residuals.squaredNorm(), static_cast<double>(views[i].pixels.size())));
  }
  return result;
}

}  // namespace ols::calibration
