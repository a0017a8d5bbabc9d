// Monte Carlo measures of the estimators' accuracy and honesty on simulated bearings. Each prints
// its table and holds what comes out against its limits. Deterministic by the number of runs.
#pragma once

#include "dev/estimators/limits.h"

namespace ols::bench {

// One epoch, many geometries: the joint least squares against the Cramer-Rao bound at the truth.
void least_squares_bound(int runs, Limits& limits);

// The filter against the posterior bound, with biases that stay or wander; alone, and configured
// for the case that a bias may stay for hours.
void filter_bounds(int runs, Limits& limits);

// A drone that manoeuvres at 200 to 800 m, four stations, against the paper's estimator: live, each
// from the bearings that have come in by then.
void against_paper(int runs, Limits& limits);

// Crossing targets with misses and false bearings.
void several(int runs, Limits& limits);

}  // namespace ols::bench
