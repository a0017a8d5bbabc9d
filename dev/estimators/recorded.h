// Compares the filter for recordings and its smoother with least squares at the same instants, on
// simulated recordings that state only the noise of the bearings.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dev/estimators/bearing_world.h"
#include "dev/estimators/limits.h"

namespace ols::bench {

struct Recording {
  std::vector<fusion::BearingMeasurement> bearings;
  Path path;                           // the truth, from 0 s
  double from_s = 0.0, until_s = 0.0;  // the estimates are compared between these times
  double rate_hz = 0.0;                // rate of the compared instants; 0: at each bearing
};

// The ratio of one estimator's errors to those of least squares, and the estimator's normalised
// error squared, over all recordings. A recording is left out if fewer than ten of its instants
// have results of all estimators.
class AgainstLeastSquares {
 public:
  // `smooth`: whether the estimator of ols-fuse is the smoother; false: the filter.
  AgainstLeastSquares(std::string name, bool smooth) : name_(std::move(name)), smooth_(smooth) {}
  void add(const Recording& recording);
  void print() const;
  // Prints, and compares with limits. The median, RMS and 95 % quantile of the error may be at most
  // 1.02 times those of least squares. The normalised error squared of an axis must be from
  // `least_nees` to 2.5.
  void judge(Limits& limits, double least_nees) const;

 private:
  double ratio(std::size_t i) const;
  double worse_percent(std::size_t i) const;

  std::string name_;
  bool smooth_;
  std::array<std::vector<double>, 3> log_ratio_;  // of median, RMS, 95 % quantile
  std::vector<double> nees_;
};

}  // namespace ols::bench
