// Draws flying objects: a multicopter, a bird that beats its wings, an aeroplane. Their parts are
// ellipsoids, with analytic anti-aliasing: positions are exact to a small fraction of a pixel. The
// multicopter is symmetric about its centre: the centroid of its drawing is the image of the
// centre.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::sim {

enum class FlyerShape { kDrone, kBird, kAircraft };

// The view of a target's body in one image.
struct FlyerView {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 3> px_per_m =
      Eigen::Matrix<double, 2, 3>::Zero();  // maps offsets in the body frame [m] to pixels
  Eigen::Vector2d smear_px = Eigen::Vector2d::Zero();  // image motion during the exposure
  FlyerShape shape = FlyerShape::kDrone;
  double span_m = 1.0;      // from rotor tip to rotor tip, or from wing tip to wing tip
  double wing_rad = 0.0;    // angle of a bird's wings above the horizontal
  double brightness = 0.2;  // of the body, 0..1
};

// The smallest upright box around the silhouette, without smear. A box is given by pixel edges, but
// (0, 0) of view.centre_px is a pixel centre: the coordinates of the box's middle are therefore
// half a pixel greater than centre_px.
cv::Rect2d flyer_box(const FlyerView& view);

// A target's contribution to an image: the new image is the background times (1 - covered), plus
// `colour`.
struct FlyerMatte {
  cv::Rect area;  // in the image; empty if no part of the target is inside
  // For the pixels of `area`; colour [gray levels] is premultiplied by `covered`.
  cv::Mat1f colour, covered;
};

FlyerMatte flyer_matte(const FlyerView& view, cv::Size picture);

void draw_flyer(const FlyerView& view, cv::Mat& gray);
void draw_flyer(const FlyerMatte& matte, cv::Mat& gray);

}  // namespace ols::sim
