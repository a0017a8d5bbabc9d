// One joint maximum-likelihood position from N rays, robust to a bad ray.
//
// Minimises sum_i r_i^T R_i^-1 r_i over the position in ECEF. r_i is the predicted direction on the
// measured ray's tangent plane (gnomonic). R_i is its white covariance plus the systematic one:
// calibration, clock error along the motion, and station position error as seen from the target.
// Directions are exact at each camera centre, so the result is valid from metres to hundreds of
// kilometres.
#pragma once

#include <vector>

#include "central/measurement/ray.h"

namespace ols::fusion {

struct LeastSquaresConfig {
  // Rays are consistent up to this limit of chi^2, given as a normal deviate: 3.1 corresponds to a
  // probability of 0.999.
  double gate_sigma = 3.1;
  double huber_sigma = 2.0;  // if no consistent subset exists, rays beyond this are down-weighted
  double range_sd_limit = 0.3;  // largest 1-sigma relative to the range; beyond it: "parallel rays"
  double max_range_m = 500e3;
  int max_iterations = 30;
};

// Rays are rejected only if the remaining rays are a majority and agree: one of three or four can
// be rejected, or two of five or six. Otherwise all rays are kept with robust weights, and the
// covariance is multiplied by chi^2 over its degrees of freedom. (Two rays that miss each other are
// always treated like this.)
Estimate least_squares(const std::vector<Ray>& rays, const LeastSquaresConfig& config = {});

// Computes the velocity and its covariance from the angular rates of all used rays together; NaN if
// the rates do not determine them.
void estimate_velocity(const std::vector<Ray>& rays, Estimate& estimate);

}  // namespace ols::fusion
