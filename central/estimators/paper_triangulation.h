// Triangulation as in section 6 of the OLS paper: the mid-plane intersection of two views,
// Algorithm 1 for N views, the choice of the best baseline (section 4.1), and a moving average.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

#include "central/measurement/ray.h"

namespace ols::fusion {

// How the pairs of stations are combined.
enum class PaperPairs {
  kAlgorithm1,    // all pairs, with the paper's weights
  kCentroid,      // all pairs, with equal weights: Algorithm 1 without its lines 5 to 8
  kBestBaseline,  // section 4.1: the pair with the largest t_i . n_i
};

// The parts of the paper's estimator. Each can be switched separately.
struct PaperConfig {
  PaperPairs pairs = PaperPairs::kAlgorithm1;
  bool by_belief = true;           // false: each view is turned by half of alpha (paper_two_view())
  int moving_average = 10;         // number h of averaged estimates; 1 for no averaging
  double min_crossing_rad = 1e-4;  // turned vectors that cross at a smaller angle count as parallel
  double max_range_m = 500e3;
  // Largest number of stations that are used for a target, in the order of their ids; 0: all.
  int max_stations = 0;
};

// One view: camera centre M, direction, and the tracker's belief b.
struct PaperView {
  Eigen::Vector3d centre_ecef = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
  double belief = 1.0;
};

struct PaperPoint {
  Solution solution = Solution::kTooFewRays;
  Eigen::Vector3d position_ecef = nan_vector();  // [m]
};

// The mid-plane intersection of two views. M1 and M2 are the camera centres, m is the axis of the
// baseline, and alpha is the angle about m between the planes of the two direction vectors. The
// vectors are turned about m towards each other, into one plane: the first by beta1 = alpha b2 /
// (b1 + b2), the second by beta2 = alpha - beta1. The vector with the higher belief turns less. The
// position W is the intersection of the turned vectors.
PaperPoint paper_two_view(const PaperView& first, const PaperView& second,
                          const PaperConfig& config = {});

// Combines all pairs of stations whose rays intersect, according to config.pairs.
//  - Algorithm 1: the weighted centroid of all pairs' estimates, with weights w_i ~ exp(n_i .
//    unit(T' - bc_i)). T' is the centroid of the pairs' points, bc_i the centre of baseline i, and
//    n_i its normal towards T'. The paper prints the exponent with the vector T' - bc_i itself,
//    which overflows at a few hundred metres. According to the paper's text, the weights express
//    the angle between n_i and this vector. The unit vector is therefore used here.
//  - Best baseline: the pair with the largest t_i . n_i, where t_i is the direction from the
//    baseline's centre to the target.
PaperPoint paper_n_view(const std::vector<PaperView>& views, const PaperConfig& config = {});

// The paper's position from rays, without the moving average. Its first-order covariance
// (paper_pairing.h) is not in the paper. The cost grows with the square of the number of rays:
// about 2 ms for 100.
Estimate paper_estimate(const std::vector<Ray>& rays, const PaperConfig& config = {});

// The paper's smoothing: the mean of the last h estimates (h = 10). The mean lags behind a moving
// target by half the time that the estimates span. The square of this lag (the newest estimate
// minus the mean) is added to the covariance. Each estimate uses the bearings of one window
// (AlignmentConfig::window_s). Where two windows overlap, the noise of their estimates is
// correlated, and the mean does not reduce the correlated part.
class MovingAverage {
 public:
  MovingAverage(int h, double window_s) : h_(h), window_s_(window_s) {}
  // Takes an estimate that has a position. Returns the average. Must be called in order of time.
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
