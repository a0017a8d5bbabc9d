// The joint maximum-likelihood position from N rays, robust against outliers.
//
// Minimises sum_i r_i^T R_i^-1 r_i over the position in ECEF. r_i is the difference between the
// predicted and the measured direction, on the measured ray's tangent plane (gnomonic). R_i is the
// covariance of the measured direction: the white part plus the systematic part, which consists of
// calibration, clock error along the motion, and station position error divided by the range. Each
// direction is computed at its own camera centre, without approximation. The result is therefore
// valid from metres to hundreds of kilometres.
#pragma once

#include <vector>

#include "central/measurement/ray.h"

namespace ols::fusion {

struct LeastSquaresConfig {
  // The limit of chi^2 up to which rays are consistent, given as a one-sided normal deviate: 3.1
  // corresponds to a probability of 0.999.
  double gate_sigma = 3.1;
  double huber_sigma = 2.0;  // rays beyond this are down-weighted, if no consistent subset exists
  double range_sd_limit = 0.3;  // largest 1-sigma relative to the range; beyond it: "parallel rays"
  double max_range_m = 500e3;
  int max_iterations = 30;
};

// Rays are rejected only if the remaining rays are a majority and agree. Of three or four rays, one
// can be rejected; of five or six, two. If no such subset exists, all rays are kept with robust
// weights, and the covariance is multiplied by chi^2 over its degrees of freedom. (This always
// applies to two rays that miss each other.)
Estimate least_squares(const std::vector<Ray>& rays, const LeastSquaresConfig& config = {});

// Adds to the estimate the velocity and its covariance, from the angular rates of all used rays
// together. NaN if the rates do not determine the velocity.
void estimate_velocity(const std::vector<Ray>& rays, Estimate& estimate);

}  // namespace ols::fusion
