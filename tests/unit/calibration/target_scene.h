// Pictures of the paper's rectification targets, drawn from boards in space by tracing rays through
// a lens with distortion. The pictures have blur, noise and uneven light, and parts of the boards
// may be hidden.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <vector>

#include "geometry/lens.h"

namespace ols::calibration::test {

// A flat board in space. `gray`: its gray level at (x to the right, y up) [m]; nullopt: outside of
// the board.
struct Board {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d right = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitZ();
  std::function<std::optional<double>(double x, double y)> gray;
};

struct Conditions {
  double blur_px = 0.8;
  double noise_gray = 2.0;
  double uneven = 0.3;  // difference of the light between opposite corners
  std::vector<cv::Rect> hidden = {};
  unsigned seed = 1;
};

inline constexpr double kWhite = 210.0, kBlack = 40.0, kBehind = 120.0;

// Parallel lines of this thickness and distance.
inline auto lines_on(double width_m, double height_m, double apart_m, double thick_m) {
  return [=](double x, double y) -> std::optional<double> {
    if (std::abs(x) > 0.5 * width_m || std::abs(y) > 0.5 * height_m) return std::nullopt;
    const double off = std::remainder(y, apart_m);
    return std::abs(off) < 0.5 * thick_m ? kBlack : kWhite;
  };
}

// The right cross is in the middle of the board, the left cross beside it; one line is above both,
// one below.
inline auto crosses_on(double apart_m, double arm_m, double thick_m) {
  return [=](double x, double y) -> std::optional<double> {
    if (std::abs(x + 0.5 * apart_m) > 0.5 * apart_m + 3.0 * arm_m || std::abs(y) > 4.0 * arm_m) {
      return std::nullopt;
    }
    const auto cross = [&](double dx) {
      const double a = std::abs(dx), b = std::abs(y);
      return (a < arm_m && b < 0.5 * thick_m) || (b < arm_m && a < 0.5 * thick_m);
    };
    const bool line = std::abs(std::abs(y) - 3.0 * arm_m) < 0.5 * thick_m;
    return line || cross(x) || cross(x + apart_m) ? kBlack : kWhite;
  };
}

// A ruler with its zero in the middle, and `bars` bars above and below.
inline auto ruler_on(double bar_m, double width_m, int bars) {
  return [=](double x, double y) -> std::optional<double> {
    const double h = std::abs(y) / bar_m;
    if (std::abs(x) > 0.5 * width_m || h > 1.5 + bars) return std::nullopt;
    if (h < 1.5) return kBlack;
    return static_cast<int>(std::floor(h - 1.5)) % 2 == 0 ? kWhite : kBlack;
  };
}

namespace detail {

// The board coordinates of pixels: exact at the nodes of a coarse grid, interpolated between them.
class OnBoard {
 public:
  OnBoard(const CameraIntrinsics& camera, const Eigen::Isometry3d& enu_cam, const Board& board)
      : columns_(camera.width_px / kStep + 2), rows_(camera.height_px / kStep + 2) {
    const Eigen::Vector3d normal = board.right.cross(board.up);
    const double height = normal.dot(board.middle - enu_cam.translation());
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < columns_; ++c) {
        const Eigen::Vector3d ray =
            enu_cam.linear() * unproject(camera, Eigen::Vector2d(c * kStep, r * kStep)).value();
        const Eigen::Vector3d p =
            enu_cam.translation() + height / normal.dot(ray) * ray - board.middle;
        nodes_.emplace_back(board.right.dot(p), board.up.dot(p));
      }
    }
  }
  Eigen::Vector2d operator()(double x, double y) const {
    const double u = std::max(0.0, x / kStep), v = std::max(0.0, y / kStep);
    const int c = std::min(columns_ - 2, static_cast<int>(u));
    const int r = std::min(rows_ - 2, static_cast<int>(v));
    const auto node = [this](int row, int column) {
      return nodes_[static_cast<std::size_t>(row * columns_ + column)];
    };
    const double a = x / kStep - c, b = y / kStep - r;
    return (1 - b) * ((1 - a) * node(r, c) + a * node(r, c + 1)) +
           b * ((1 - a) * node(r + 1, c) + a * node(r + 1, c + 1));
  }

 private:
  static constexpr int kStep = 16;
  int columns_, rows_;
  std::vector<Eigen::Vector2d> nodes_;
};

}  // namespace detail

// Draws the picture. At each pixel, the first board there hides the boards after it.
inline cv::Mat picture_of(const CameraIntrinsics& camera, const Eigen::Isometry3d& enu_cam,
                          const std::vector<Board>& boards, const Conditions& conditions = {}) {
  constexpr int kFine = 3;
  std::vector<detail::OnBoard> places;
  for (const Board& board : boards) places.emplace_back(camera, enu_cam, board);
  cv::Mat gray(camera.height_px, camera.width_px, CV_32F);
  for (int y = 0; y < gray.rows; ++y) {
    for (int x = 0; x < gray.cols; ++x) {
      double sum = 0.0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const double sx = x + (k % kFine - 1) / 3.0, sy = y + (k / kFine - 1) / 3.0;
        double value = kBehind;
        for (std::size_t i = 0; i < boards.size(); ++i) {
          const Eigen::Vector2d p = places[i](sx, sy);
          if (const auto seen = boards[i].gray(p.x(), p.y())) {
            value = *seen;
            break;
          }
        }
        sum += value;
      }
      const double across = static_cast<double>(x) / gray.cols + static_cast<double>(y) / gray.rows;
      gray.at<float>(y, x) =
          static_cast<float>(sum / (kFine * kFine) * (1.0 - 0.5 * conditions.uneven * across));
    }
  }
  for (const cv::Rect& rect : conditions.hidden) cv::rectangle(gray, rect, kBehind, cv::FILLED);
  if (conditions.blur_px > 0.0) cv::GaussianBlur(gray, gray, {}, conditions.blur_px);
  cv::RNG noise(conditions.seed);
  cv::Mat grain(gray.size(), CV_32F);
  noise.fill(grain, cv::RNG::NORMAL, 0.0, conditions.noise_gray);
  cv::Mat result;
  cv::Mat(gray + grain).convertTo(result, CV_8U);
  return result;
}

// A camera with the usual lens and pictures of half the size.
inline CameraIntrinsics half_size_camera() {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 6666.7;
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  camera.k1 = -0.25;
  return camera;
}
// The pose of a camera that looks north, after it was rolled (clockwise as seen from behind),
// turned to the right and tilted up.
inline Eigen::Isometry3d looking_north(double roll_rad = 0.0, double right_rad = 0.0,
                                       double up_rad = 0.0) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // right: east, down, forward: north
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = AngleAxisd(-right_rad, Vector3d::UnitZ()) *
                  AngleAxisd(up_rad, Vector3d::UnitX()) * AngleAxisd(roll_rad, Vector3d::UnitY()) *
                  axes;
  return pose;
}

}  // namespace ols::calibration::test
