// How well each station's rays agree with the rest, over tens of seconds; and what their stated
// covariances leave out.
//
// One epoch's residuals are too few to tell. Over many, the squared residuals against their
// expectation (variance components by redundancy, after Foerstner) give each station's true mean
// variance. What it has beyond its statement is added to its rays as an error that stays. A station
// that states what is not known of its pose is believed up to a margin: one constant error is one
// draw, however often it is seen. A station that states nothing of that kind is not.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "central/ray.h"

namespace ols {

struct ResidualConfig {
  double memory_s = 30.0;          // residuals older than this count less than 1/e
  double prior_weight = 4.0;       // residual components' worth of trust in the statement
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

 private:
  struct Station {
    std::int64_t epoch_us = 0;
    double weight = 0.0;    // sum of expectations
    double variance = 0.0;  // sum of squared residuals [rad^2]
    double squared = 0.0;   // sum of squared normalised residuals
  };
  ResidualConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols
