// The paper's precision theory (section 4.1): by how much an error of p pixels displaces a target
// that two cameras see. Plane geometry; lengths in metres, angles in radians.
//
// Every error here is a worst case, not a standard deviation. A camera's measurement is wrong by at
// most p pixels. The result is the largest distance from the true position that this can cause;
// infinity if the distance is unbounded.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace ols {

// An error in pixels, and the camera (the paper's p, r and f).
struct PixelError {
  double pixels = 1.0;
  double pixel_m = 3.75e-6;  // r: the horizontal size of one pixel
  double focal_length_m = 50e-3;

  double tangent() const { return pixels * pixel_m / focal_length_m; }
};

// E = p r Z^2 / (f b - p r Z), exact. Two parallel cameras are a base b apart. The disparity of a
// target at depth Z is measured p pixels too small. With p = 1, E is the depth resolution R.
double canonical_stereo_error_m(const PixelError& error, double base_m, double depth_m);

// E = B tan(arctan(D / B) + arctan(p r / f)) - D, for cameras that can rotate. The cameras are a
// base B apart. The target is straight ahead of the first camera at distance D, and only the second
// camera is in error. The paper prints arctan(r / f), which is the case p = 1.
double rotating_pair_error_m(const PixelError& error, double base_m, double distance_m);

// The largest distance from the target at which the two rays can intersect. Each camera's direction
// is wrong by up to angle_rad, in the plane of the cameras and the target. The possible rays of
// each camera form a wedge, and the possible intersections fill the overlap of the two wedges. The
// overlap is convex. The farthest point is therefore a corner.
double pair_error_m(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                    const Eigen::Vector3d& target, double angle_rad);

// A pair of cameras.
struct Baseline {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Vector3d second = Eigen::Vector3d::Zero();
};

// t . n of the paper: t is the unit vector from the baseline's centre to the target; n is the unit
// normal of the baseline, in the plane of baseline and target and on the target's side. t . n is
// the sine of the angle between t and the baseline, 0..1. It is defined as 0 for a target at the
// baseline's centre.
double normal_component(const Baseline& baseline, const Eigen::Vector3d& target);

// Returns the index i of the baseline with the largest t_i . n_i; among equal values, the first.
// Throws std::invalid_argument if there are no baselines.
std::size_t best_baseline(std::span<const Baseline> baselines, const Eigen::Vector3d& target);

// The position of the target in a row of the paper's Table 1: in the plane (x along the base, y
// across it), relative to the base's centre. The paper does not say from where the distance is
// measured, nor on which side of the base's normal the target is. `side` selects an interpretation.
// 0: the distance is measured from the centre of the base. -1 or +1: the distance is measured from
// the first camera (at x = -base/2), and the target is on the side of that camera (-1) or on the
// other side (+1). alpha_rad: the angle between the base's normal and the target, at the base's
// centre.
Eigen::Vector3d table_target(double base_m, double distance_m, double alpha_rad, int side);

}  // namespace ols
