// The paper's precision theory (section 4.1): the displacement of a target, seen by two cameras,
// that an error of p pixels causes. Plane geometry; lengths in metres, angles in radians.
//
// Every error here is a worst case, not a standard deviation: the pixels are off by up to p. The
// result is the largest distance from the truth that such an error can cause; infinity if it is
// unbounded.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace ols {

// An error of a number of pixels (the paper's p, r and f).
struct PixelError {
  double pixels = 1.0;
  double pixel_m = 3.75e-6;  // r: the horizontal size of one pixel
  double focal_length_m = 50e-3;

  double tangent() const { return pixels * pixel_m / focal_length_m; }
};

// E = p r Z^2 / (f b - p r Z), exact. Two parallel cameras have a base b, and a target at depth Z
// has a disparity that is p pixels too small. With p = 1 it is the depth resolution R.
double canonical_stereo_error_m(const PixelError& error, double base_m, double depth_m);

// E = B tan(arctan(D / B) + arctan(p r / f)) - D, for cameras that can rotate. The target is
// straight ahead of the first camera at distance D, and only the second camera is in error. The
// paper prints arctan(r / f), which is p = 1.
double rotating_pair_error_m(const PixelError& error, double base_m, double distance_m);

// The largest distance from the target at which the two rays can meet, for errors of up to
// angle_rad in both cameras, in the plane of the cameras and the target. The possible intersections
// fill the overlap of two wedges. The overlap is convex, so the farthest point is a corner.
double pair_error_m(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                    const Eigen::Vector3d& target, double angle_rad);

// A pair of cameras.
struct Baseline {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Vector3d second = Eigen::Vector3d::Zero();
};

// t . n of the paper: t is the unit vector from the baseline's centre to the target, n the
// baseline's unit normal in their common plane, on the target's side. This is the sine of the angle
// between t and the baseline, 0..1. It is also 0 for a target at the baseline's centre.
double normal_component(const Baseline& baseline, const Eigen::Vector3d& target);

// Returns i = argmax t_i . n_i; of equal values, the first. Throws std::invalid_argument without
// pairs.
std::size_t best_baseline(std::span<const Baseline> baselines, const Eigen::Vector3d& target);

// The target of a row of the paper's Table 1, in the plane (x along the base, y across it),
// relative to the base's centre. The paper does not say from where the distance is measured, nor on
// which side of the base's normal the target is. `side` 0: the distance is from the centre of the
// base. Otherwise the distance is from the first camera (at x = -base/2), and the target is on the
// side of that camera (-1) or on the other side (+1). alpha_rad: the angle at the base's centre,
// from its normal.
Eigen::Vector3d table_target(double base_m, double distance_m, double alpha_rad, int side);

}  // namespace ols
