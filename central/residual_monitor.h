// How well each station's rays agree with the rest, over tens of seconds; and what their stated
// covariances leave out.
//
// One epoch's residuals are too few to tell. Over many, the squared residuals against their
// expectation (variance components by redundancy, after Foerstner) give each station's true mean
// variance. What it has beyond its white noise is added to its rays as an error that stays. A
// station that states what is not known of its pose is believed up to a margin: one constant error
// is one draw, however often it is seen. A station that states nothing of that kind is not.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "central/ray.h"

namespace ols {

struct ResidualConfig {
  double memory_s = 120.0;         // residuals older than this count less than 1/e
  double independence_s = 3.0;     // residuals nearer to each other are no news: such errors stay
  double prior_weight = 2.0;       // residuals' worth of trust in the statements
  double common_weight = 10.0;     // residuals' worth that a station is taken to be like the rest
  double systematic_margin = 9.0;  // stated systematic variance is believed up to this many times
  double clip = 16.0;              // greatest squared residual over its expectation in one epoch
};

class ResidualMonitor {
 public:
  explicit ResidualMonitor(const ResidualConfig& config = {}) : config_(config) {}

  // Adds to the ray's systematic covariance what its station's residuals show beyond it.
  void inflate(Ray& ray) const;
  // Takes the residuals of an estimate made from (inflated) rays.
  void observe(const std::vector<Ray>& rays, const Estimate& estimate, std::int64_t epoch_us);
  // RMS of a station's normalised residuals lately; NaN if there are none.
  double rms(const std::string& station) const;
  void forget(const std::string& station) { stations_.erase(station); }

 private:
  Eigen::Array2d common_excess() const;

  struct Station {
    std::int64_t epoch_us = 0;
    // By component (cross-elevation, elevation), decaying sums:
    Eigen::Array2d weight = Eigen::Array2d::Zero();       // of redundancies
    Eigen::Array2d excess_rad2 = Eigen::Array2d::Zero();  // of squared residuals beyond white noise
    double squared = 0.0;                                 // of squared normalised residuals
    double expected = 0.0;                                // of their expectations
  };
  ResidualConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols
