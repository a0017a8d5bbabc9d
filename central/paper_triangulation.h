// Triangulation as in the OLS paper, section 6: the mid-plane intersection of two views, Algorithm
// 1 for N views, the choice of the best baseline (section 4.1), and the moving average.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

#include "central/ray.h"

namespace ols {

struct PaperConfig {
  double min_crossing_rad = 1e-4;  // below, u' and v' count as parallel
  double max_range_m = 500e3;
};

// One of the two views: camera centre M, direction and the tracker's belief b.
struct PaperView {
  Eigen::Vector3d centre_ecef = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
  double belief = 1.0;
};

struct PaperPoint {
  Solution solution = Solution::kTooFewRays;
  Eigen::Vector3d position_ecef = nan_vector();  // [m]
};

// Both vectors are turned about the baseline's axis m into one plane M1 M2 W: by beta1 = alpha b2 /
// (b1 + b2) and beta2 = alpha - beta1, so the more believed one turns less; W is where they cross.
PaperPoint paper_two_view(const PaperView& first, const PaperView& second,
                          const PaperConfig& config = {});

// Algorithm 1: the weighted centroid of the estimates of all pairs of stations. The weights are
// w_i ~ exp(n_i . unit(T' - bc_i)) with bc_i the baseline's centre and n_i its normal towards T'.
// The paper prints the exponent with the vector T' - bc_i itself; in metres that overflows at a few
// hundred of them, and what the weights are to express, by the paper's own words, is the angle:
// hence the unit vector. Pairs without an intersection are left out.
PaperPoint paper_n_view(const std::vector<PaperView>& views, const PaperConfig& config = {});

// Section 4.1: of all baselines the one with the greatest t_i . n_i, t_i being the direction from
// its centre to the target, and the intersection of its two views alone.
PaperPoint paper_best_baseline(const std::vector<PaperView>& views, const PaperConfig& config = {});

using PaperEstimator = PaperPoint (*)(const std::vector<PaperView>&, const PaperConfig&);

// Any of the estimators above on rays, with its first-order covariance, which the paper does not
// give: the estimator is differentiated numerically by the rays' directions.
Estimate paper_estimate(PaperEstimator estimator, const std::vector<Ray>& rays,
                        const PaperConfig& config = {});

// The paper's smoothing: the mean of the last h estimates (h = 10). It trails a moving target by
// half of its span; that lag (the newest estimate against the mean) is put into the covariance.
class MovingAverage {
 public:
  explicit MovingAverage(int h = 10) : h_(h) {}
  // Takes an estimate with a solution; gives the average in its place.
  Estimate add(const Estimate& estimate);
  void reset() { estimates_.clear(); }

 private:
  int h_;
  std::deque<Estimate> estimates_;
};

}  // namespace ols
