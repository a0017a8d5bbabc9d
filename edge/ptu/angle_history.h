// The PTU's angles over time, interpolated at an exposure instant. Pure.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols {

struct AngleSample {
  double time_s = 0.0;     // station's monotonic clock: estimate of when the unit read its counters
  double time_sd_s = 0.0;  // 1-sigma of that estimate (white)
  PanTilt angles;
  std::optional<double>
      tilt_time_sd_s;  // where the tilt's instant is known less well than the pan's
};

struct AngleAt {
  PanTilt angles;
  PanTilt rate;                // [rad/s]
  Eigen::Matrix2d covariance;  // [rad^2] (pan, tilt): encoder step, time jitter, extrapolation
  bool interpolated = false;   // false: the instant lies after the newest sample
};

class AngleHistory {
 public:
  struct Config {
    double span_s = 5.0;                  // kept
    double max_gap_s = 0.25;              // no interpolation across more than this
    double max_extrapolation_s = 0.15;    // no answer further than this after the newest sample
    double step_rad = 5.61e-5;            // one encoder step: 11.5714 arc seconds
    double acceleration_sd_rad_s2 = 0.2;  // what the motion between samples may do
  };
  explicit AngleHistory(const Config& config) : config_(config) {}

  // Samples come in time order; one that does not is refused.
  bool add(const AngleSample& sample);
  void clear() { samples_.clear(); }

  // Angles at an instant [s], or nothing outside of what is known.
  std::optional<AngleAt> at(double time_s) const;
  std::optional<AngleSample> newest() const;

 private:
  Config config_;
  std::deque<AngleSample> samples_;
};

}  // namespace ols
