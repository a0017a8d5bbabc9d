// The PTU's angles over time, interpolated at an exposure instant. Pure.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

struct AngleSample {
  double time_s = 0.0;     // station's monotonic clock: estimate of when the unit read its counters
  double time_sd_s = 0.0;  // 1-sigma of that estimate (white)
  PanTilt angles;
  // Set if tilt and pan were read at different instants: the 1-sigma of the tilt's instant, and how
  // much later it was.
  std::optional<double> tilt_time_sd_s = {};
  double tilt_delay_s = 0.0;
  PanTilt doubt = {};  // [rad] 1-sigma of further errors of each angle
  // Share of the variance of one encoder step that remains after averaging several readings.
  PanTilt step_share = {1.0, 1.0};
  // [rad/s^2] approximate commanded acceleration since the previous sample.
  PanTilt acceleration = {};
};

struct AngleAt {
  PanTilt angles;
  PanTilt rate;                // [rad/s]
  Eigen::Matrix2d covariance;  // [rad^2] (pan, tilt): encoder step, time jitter, acceleration
  bool interpolated = false;   // false: the instant lies after the newest sample
};

class AngleHistory {
 public:
  struct Config {
    double span_s = 5.0;                // kept
    double max_gap_s = 0.25;            // no interpolation across more than this
    double max_extrapolation_s = 0.15;  // no answer further than this after the newest sample
    double step_rad = 5.61e-5;          // one encoder step: 11.5714 arc seconds
    // Accelerations. Between two samples the first value is expected; more is expected where the
    // unit was commanded to accelerate, or where the neighbouring samples show that it did. After
    // the newest sample the unit may have begun to accelerate by up to the second value.
    double acceleration_sd_rad_s2 = 0.04;
    double acceleration_max_rad_s2 = 1.0;
  };
  explicit AngleHistory(const Config& config) : config_(config) {}

  // Add samples in time order; a sample out of order is rejected.
  bool add(const AngleSample& sample);
  void clear() { samples_.clear(); }

  // The angles at an instant [s]; nothing if the samples do not cover it.
  std::optional<AngleAt> at(double time_s) const;
  std::optional<AngleSample> newest() const;

 private:
  // One axis at one sample.
  struct Knot {
    double time_s, time_sd_s, angle_rad, doubt_rad, acceleration_rad_s2, step_share;
  };
  struct AxisAt {
    double angle_rad, rate_rad_s, variance_rad2;
    bool interpolated;
  };
  static Knot pan_knot(const AngleSample& sample);
  static Knot tilt_knot(const AngleSample& sample);
  using KnotOf = Knot (*)(const AngleSample&);

  std::optional<AxisAt> axis_at(double time_s, KnotOf knot) const;
  // Variance of the measured angle at a knot passed at this rate.
  double knot_variance(const Knot& knot, double rate_rad_s) const;
  // Square of the acceleration to expect between samples_[b-1] and samples_[b]: the commanded
  // acceleration, or what the neighbouring samples show beyond their noise.
  double bend2(std::size_t b, KnotOf knot) const;
  double bend2_at(std::size_t middle, KnotOf knot) const;

  Config config_;
  std::deque<AngleSample> samples_;
};

}  // namespace ols::mount
