// A simulated recording for ols-fuse whose files state nothing but the noise of the bearings.
// Compares the filter and its smoother with least squares, at the same instants.
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
  double from_s = 0.0, until_s = 0.0;  // the judged instants are between these
  double rate_hz = 0.0;                // of the judged instants; 0: at each bearing
};

// The errors of one estimator over those of least squares, and its normalised error squared, over
// all recordings. Recordings are left out if fewer than ten instants have results of all
// estimators.
class AgainstLeastSquares {
 public:
  // An estimator of ols-fuse: the filter, or its smoother.
  AgainstLeastSquares(std::string name, bool smooth) : name_(std::move(name)), smooth_(smooth) {}
  void add(const Recording& recording);
  void print() const;
  // Prints, and judges: median, RMS and 95 % of the error at most 1.02 of that of least squares;
  // the normalised error squared of an axis from `least_nees` to 2.5.
  void judge(Limits& limits, double least_nees) const;

 private:
  double ratio(std::size_t i) const;
  double worse_percent(std::size_t i) const;

  std::string name_;
  bool smooth_;
  std::array<std::vector<double>, 3> log_ratio_;  // of median, RMS, 95 %
  std::vector<double> nees_;
};

}  // namespace ols::bench
