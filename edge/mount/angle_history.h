// The angles of a mount over time, interpolated for the instant of an exposure. Pure.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

struct AngleSample {
  // Estimated instant at which the mount read its counters, on the station's monotonic clock.
  double time_s = 0.0;
  double time_sd_s = 0.0;  // 1-sigma of time_s (white)
  PanTilt angles;
  // Set if tilt and pan were read at different instants: 1-sigma of the instant of the tilt
  // reading, and the time from the pan reading to the tilt reading.
  std::optional<double> tilt_time_sd_s = {};
  double tilt_delay_s = 0.0;
  PanTilt doubt = {};  // [rad] 1-sigma of each angle's errors that no other member describes
  // [rad] 1-sigma of an error that depends on the axis's position, and stays the same while the
  // axis stands there: backlash, repeatability.
  PanTilt place_sd = {};
  // Share of the variance of one encoder step that remains after averaging several readings.
  PanTilt step_share = {1.0, 1.0};
  // [rad/s^2] Approximate acceleration that was ordered since the previous sample.
  PanTilt acceleration = {};
  // [rad/s] Change of the ordered rate from shortly before the previous sample to the arrival of
  // this one; nullopt if unknown.
  std::optional<PanTilt> ordered_change = {};
  double shared_time_sd_s = 0.0;  // 1-sigma of an error that time_s of all samples have in common
};

struct AngleAt {
  PanTilt angles;
  PanTilt rate;  // [rad/s]
  // [rad^2] (pan, tilt): errors from the encoder step, time jitter and unknown acceleration, and
  // the error that depends on the position (place_sd).
  Eigen::Matrix2d covariance;
  // [rad^2] (pan, tilt): the part of the error that depends on the position and does not average
  // out, because it was not observed to change.
  Eigen::Matrix2d lasting_covariance = Eigen::Matrix2d::Zero();
  bool interpolated = false;  // false if the angles were extrapolated beyond the newest sample
};

class AngleHistory {
 public:
  struct Config {
    double span_s = 5.0;      // how long samples are kept
    double max_gap_s = 0.25;  // longest interval between samples over which angles are interpolated
    // Longest time after the newest sample for which angles are extrapolated.
    double max_extrapolation_s = 0.15;
    double step_rad = 5.61e-5;  // one encoder step: 11.5714 arc seconds
    // The unknown accelerations. The first value is assumed between two samples; more is assumed if
    // an acceleration was ordered, or if the neighbouring samples show one. The second value is the
    // largest acceleration that may have begun after the newest sample. If that sample states
    // ordered_change, this change is used instead.
    double acceleration_sd_rad_s2 = 0.04;
    double acceleration_max_rad_s2 = 1.0;
  };
  explicit AngleHistory(const Config& config) : config_(config) {}

  // Adds a sample. Returns false and drops it if it is not later than the previous one, or not
  // finite.
  bool add(const AngleSample& sample);
  void clear() { samples_.clear(); }

  // The angles at an instant; nullopt if the samples do not cover it.
  std::optional<AngleAt> at(double time_s) const;
  std::optional<AngleSample> newest() const;

 private:
  // One axis at one sample.
  struct Knot {
    double time_s, time_sd_s, shared_time_sd_s, angle_rad, doubt_rad, place_sd_rad,
        acceleration_rad_s2, step_share;
    std::optional<double> ordered_change_rad_s;
  };
  struct AxisAt {
    double angle_rad, rate_rad_s, variance_rad2, lasting_rad2;
    bool interpolated;
  };
  static Knot pan_knot(const AngleSample& sample);
  static Knot tilt_knot(const AngleSample& sample);
  using KnotOf = Knot (*)(const AngleSample&);

  std::optional<AxisAt> axis_at(double time_s, KnotOf knot) const;
  // Variance of the measured angle at a knot, for an axis that passes it at this rate.
  double knot_variance(const Knot& knot, double rate_rad_s) const;
  // Variance of the angle from a change of rate that may have begun after the newest sample.
  double begun_variance(const Knot& newest, double beyond_s) const;
  // Square of the acceleration to assume between samples_[b-1] and samples_[b]. It is the larger
  // one of two: the ordered acceleration, and the acceleration that the neighbouring samples show
  // beyond their noise.
  double bend2(std::size_t b, KnotOf knot) const;
  double bend2_at(std::size_t middle, KnotOf knot) const;

  Config config_;
  std::deque<AngleSample> samples_;
};

}  // namespace ols::mount
