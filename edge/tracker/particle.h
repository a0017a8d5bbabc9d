// The filter's state (x, y, vx, vy, h, w), and shared plane geometry.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/core.hpp>

namespace ols::tracker {

struct Particle {
  // Centre of the box; (0, 0) is the centre of the top-left pixel.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // Relative to the scene, not to the image.
  Eigen::Vector2d velocity_px_s = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();  // width, height
};

// In a cv::Rect2d, whole numbers are pixel edges; in a Particle, whole numbers are pixel centres.
inline cv::Rect2d box_of(const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px) {
  return {pixel.x() + 0.5 - size_px.x() / 2.0, pixel.y() + 0.5 - size_px.y() / 2.0, size_px.x(),
          size_px.y()};
}

inline Eigen::Vector2d centre_of(const cv::Rect2d& box) {
  return {box.x + box.width / 2.0 - 0.5, box.y + box.height / 2.0 - 0.5};
}

// The whole pixels that a box touches.
inline cv::Rect enclosing(const cv::Rect2d& box) {
  return {static_cast<int>(std::floor(box.x)), static_cast<int>(std::floor(box.y)),
          static_cast<int>(std::ceil(box.width)) + 1, static_cast<int>(std::ceil(box.height)) + 1};
}

inline Eigen::Vector2d size_of(const cv::Rect2d& box) { return {box.width, box.height}; }

inline Eigen::Vector2d transform(const Eigen::Matrix3d& homography, const Eigen::Vector2d& pixel) {
  return (homography * pixel.homogeneous()).hnormalized();
}

}  // namespace ols::tracker
