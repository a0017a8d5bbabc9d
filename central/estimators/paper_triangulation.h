// Triangulation as in the OLS paper, section 6: the mid-plane intersection of two views, Algorithm
// 1 for N views, the choice of the best baseline (section 4.1), and the moving average.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

#include "central/measurement/ray.h"

namespace ols::fusion {

// What becomes of the pairs of stations.
enum class PaperPairs {
  kAlgorithm1,    // all of them, weighted
  kCentroid,      // all of them, with equal weights: Algorithm 1 without its lines 5 to 8
  kBestBaseline,  // section 4.1: the one with the greatest t_i . n_i
};

// The parts of the paper's estimator; each can be switched alone.
struct PaperConfig {
  PaperPairs pairs = PaperPairs::kAlgorithm1;
  bool by_belief = true;           // false: both views turn by half of the angle
  int moving_average = 10;         // h estimates; 1: none
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

// All pairs of stations that meet, put together as config.pairs says. Algorithm 1: the weighted
// centroid of the estimates of all pairs. The weights are w_i ~ exp(n_i . unit(T' - bc_i)) with
// bc_i the baseline's centre and n_i its normal towards T'. The paper prints the exponent with the
// vector T' - bc_i itself; in metres that overflows at a few hundred of them, and what the weights
// are to express, by the paper's own words, is the angle: hence the unit vector. Best baseline: the
// one with the greatest t_i . n_i, t_i being the direction from its centre to the target.
PaperPoint paper_n_view(const std::vector<PaperView>& views, const PaperConfig& config = {});

// The same on rays, with its first-order covariance, which the paper does not give: the estimator
// is differentiated numerically by the rays' directions. Without the moving average.
Estimate paper_estimate(const std::vector<Ray>& rays, const PaperConfig& config = {});

// The paper's smoothing: the mean of the last h estimates (h = 10). It trails a moving target by
// half of its span; that lag (the newest estimate against the mean) is put into the covariance.
// Estimates are made of the bearings of a window (AlignmentConfig::window_s): where the windows of
// two overlap they have so much of their noise in common, which the mean does not make smaller.
class MovingAverage {
 public:
  MovingAverage(int h, double window_s) : h_(h), window_s_(window_s) {}
  // Takes an estimate with a solution; gives the average in its place. In order of time.
  Estimate add(const Estimate& estimate, std::int64_t utime_us);
  void reset() { estimates_.clear(); }

 private:
  double shared(std::int64_t first_us, std::int64_t second_us) const;

  struct Timed {
    std::int64_t utime_us;
    Estimate estimate;
  };
  int h_;
  double window_s_;
  std::deque<Timed> estimates_;
};

}  // namespace ols::fusion
