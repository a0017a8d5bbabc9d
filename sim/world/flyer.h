// Draws a multicopter: body, arms, motors and rotors as ellipsoids, with analytic anti-aliasing, so
// that its position is exact to a fraction of a pixel. Symmetric about its centre: the centroid of
// the drawing is the image of the centre.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::sim {

// The view of a target's body in one image.
struct DroneView {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 3> px_per_m =
      Eigen::Matrix<double, 2, 3>::Zero();             // from the body frame
  Eigen::Vector2d smear_px = Eigen::Vector2d::Zero();  // image motion during the exposure
  double span_m = 1.0;
  double brightness = 0.2;  // of the body, 0..1
};

// Smallest upright box around the silhouette, without smear. Boxes are given by pixel edges, while
// (0, 0) of view.centre_px is a pixel centre: the box's middle is half a pixel further.
cv::Rect2d drone_box(const DroneView& view);

// A target's contribution to an image: the background times (1 - covered), plus `colour`.
struct DroneMatte {
  cv::Rect area;              // in the image; empty if no part of the target is inside
  cv::Mat1f colour, covered;  // of `area`; colour [gray levels] is premultiplied by `covered`
};

DroneMatte drone_matte(const DroneView& view, cv::Size picture);

void draw_drone(const DroneView& view, cv::Mat& gray);

}  // namespace ols::sim
