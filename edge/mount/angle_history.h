// The PTU's angles over time, interpolated at the instant of an exposure. Pure.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

struct AngleSample {
  // Station's monotonic clock: estimated instant at which the unit read its counters.
  double time_s = 0.0;
  double time_sd_s = 0.0;  // 1-sigma of that estimate (white)
  PanTilt angles;
  // Set if tilt and pan were read at different instants: 1-sigma of the instant of the tilt
  // reading, and how much later than the pan reading it was.
  std::optional<double> tilt_time_sd_s = {};
  double tilt_delay_s = 0.0;
  PanTilt doubt = {};  // [rad] 1-sigma of other errors of each angle
  // [rad] 1-sigma of an error that depends on the place, and is the same as long as the unit stands
  // there: backlash, repeatability.
  PanTilt place_sd = {};
  // Share of the variance of one encoder step that remains after averaging several readings.
  PanTilt step_share = {1.0, 1.0};
  // [rad/s^2] approximate acceleration that was commanded since the previous sample.
  PanTilt acceleration = {};
  // [rad/s] by how much the ordered rate changed from shortly before the previous sample until this
  // one arrived; nullopt if it is not known.
  std::optional<PanTilt> ordered_change = {};
  double shared_time_sd_s = 0.0;  // 1-sigma of an error that the instants of all samples share
};

struct AngleAt {
  PanTilt angles;
  PanTilt rate;  // [rad/s]
  // [rad^2] (pan, tilt): from encoder step, time jitter, acceleration; and from the place, which
  // changes as the unit turns.
  Eigen::Matrix2d covariance;
  // [rad^2] (pan, tilt): from the place, as far as it is not seen to change. It does not average
  // out.
  Eigen::Matrix2d lasting_covariance = Eigen::Matrix2d::Zero();
  bool interpolated = false;  // false if the instant is after the newest sample
};

class AngleHistory {
 public:
  struct Config {
    double span_s = 5.0;      // how long samples are kept
    double max_gap_s = 0.25;  // longest gap across which angles are interpolated
    // Longest time after the newest sample for which there is an answer.
    double max_extrapolation_s = 0.15;
    double step_rad = 5.61e-5;  // one encoder step: 11.5714 arc seconds
    // The assumed accelerations. The first value holds between two samples; more is assumed if the
    // unit was commanded to accelerate, or if the neighbouring samples show that it did. The second
    // value is the largest that the unit may have begun after the newest sample, unless the sample
    // says by how much the ordered rate has changed.
    double acceleration_sd_rad_s2 = 0.04;
    double acceleration_max_rad_s2 = 1.0;
  };
  explicit AngleHistory(const Config& config) : config_(config) {}

  // Add samples in order of time; a sample out of order is rejected.
  bool add(const AngleSample& sample);
  void clear() { samples_.clear(); }

  // The angles at an instant [s]; nullopt if the samples do not cover it.
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
  // Variance of the measured angle at a knot that the axis passes at this rate.
  double knot_variance(const Knot& knot, double rate_rad_s) const;
  // Variance of a change of rate that began after the newest sample.
  double begun_variance(const Knot& newest, double beyond_s) const;
  // Square of the acceleration to expect between samples_[b-1] and samples_[b]: the commanded
  // acceleration, or the one that neighbouring samples show beyond their noise.
  double bend2(std::size_t b, KnotOf knot) const;
  double bend2_at(std::size_t middle, KnotOf knot) const;

  Config config_;
  std::deque<AngleSample> samples_;
};

}  // namespace ols::mount
