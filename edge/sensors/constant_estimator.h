// Estimates a constant from repeated measurements, such as a tripod's position or tilt. Pure.
//
// Readings are averaged with weights 1/sd^2 (sd: 1-sigma). Their errors are assumed to be fully
// correlated, because multipath and a sensor's zero error last for hours. The sd of the average is
// therefore the weighted mean of the readings' sds; it does not decrease with the number of
// readings. A reading that is inconsistent with the average is rejected. Rejected readings that
// agree with each other are averaged separately. This second average replaces the first one only if
// the configuration permits it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

namespace ols::sensors {

template <int N>
class ConstantEstimator {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  struct Config {
    // [sigma] largest deviation of a consistent reading, for each component.
    double gate_sigma = 5.0;
    double memory_s = 3600.0;  // time in which the weight of a reading decreases by a factor of e
    int settle_readings = 3;   // number of readings that must agree before there is an estimate
    // The rejected readings replace the value after they have agreed for this time; 0 for never.
    double accept_move_s = 0.0;
    // The same for a resumed value that no reading has confirmed.
    double replace_resumed_s = 60.0;
  };
  struct Estimate {
    Vector value = Vector::Zero();
    Vector sd = Vector::Zero();
  };

  // `survey`: a surveyed value, which readings never change; nullopt if there is none.
  ConstantEstimator(const Config& config, const std::optional<Estimate>& survey)
      : config_(config), survey_(survey) {}

  // Resumes the value that was known before a restart. It is kept until a reading confirms it, or
  // until readings agree on another value for replace_resumed_s. Call before the first reading. Has
  // no effect if there is a survey.
  void resume(double time_s, const Estimate& known) {
    if (survey_) return;
    average_ = {};
    average_.add(time_s, known.value, known.sd, config_.memory_s);
    support(time_s);
    resumed_ = true;
  }
  // Whether the estimate is a resumed value that no reading has confirmed yet.
  bool resumed() const { return resumed_; }

  // Adds a reading with its 1-sigma. Readings must be in order of time and finite, with sd > 0.
  void add(double time_s, const Vector& value, const Vector& sd) {
    if (!first_s_) first_s_ = time_s;
    const std::optional<Estimate> kept = estimate();
    if (!kept) {
      gather(time_s, value, sd);
      if (candidate_.count >= config_.settle_readings) adopt(time_s);
    } else if (agrees(*kept, value, sd)) {
      if (!survey_) average_.add(time_s, value, sd, config_.memory_s);
      support(time_s);
    } else {
      distance_ = value - kept->value;
      if (!disagrees_since_s_) disagrees_since_s_ = time_s;
      gather(time_s, value, sd);
      const double accept_s = resumed_ ? config_.replace_resumed_s : config_.accept_move_s;
      if (!survey_ && accept_s > 0.0 && time_s - candidate_.since_s >= accept_s) {
        moved_ = distance_.norm();
        adopt(time_s);
      }
    }
  }

  std::optional<Estimate> estimate() const {
    if (survey_) return survey_;
    if (average_.count == 0) return std::nullopt;
    return average_.estimate();
  }

  // The time of the last consistent reading or, if there was none, of the first reading. nullopt
  // before any reading.
  std::optional<double> supported_until_s() const { return support_s_ ? support_s_ : first_s_; }
  // The time since which all readings have been inconsistent; nullopt if the last one was
  // consistent.
  std::optional<double> disagrees_since_s() const { return disagrees_since_s_; }
  // The last inconsistent reading minus the estimate at that time.
  const Vector& distance() const { return distance_; }
  // The distance from the old value to the new one when the value was last replaced; nullopt if it
  // never was.
  std::optional<double> moved() const { return moved_; }

 private:
  struct Average {
    Vector weight = Vector::Zero(), value_sum = Vector::Zero(), sd_sum = Vector::Zero();
    double since_s = 0.0, time_s = 0.0;
    int count = 0;

    void add(double now_s, const Vector& value, const Vector& sd, double memory_s) {
      if (count == 0) since_s = now_s;
      const double kept = std::exp(-std::max(0.0, now_s - time_s) / memory_s);
      const Vector w = sd.cwiseAbs2().cwiseInverse();
      weight = kept * weight + w;
      value_sum = kept * value_sum + w.cwiseProduct(value);
      sd_sum = kept * sd_sum + w.cwiseProduct(sd);
      time_s = now_s;
      count = std::min(count + 1, 1'000'000);
    }
    Estimate estimate() const {
      return {value_sum.cwiseQuotient(weight), sd_sum.cwiseQuotient(weight)};
    }
  };

  bool agrees(const Estimate& kept, const Vector& value, const Vector& sd) const {
    const Vector gate = config_.gate_sigma * (sd.cwiseAbs2() + kept.sd.cwiseAbs2()).cwiseSqrt();
    return ((value - kept.value).cwiseAbs().array() <= gate.array()).all();
  }

  // Adds a reading to the average of the readings that are not (yet) accepted.
  void gather(double time_s, const Vector& value, const Vector& sd) {
    if (candidate_.count > 0 && !agrees(candidate_.estimate(), value, sd)) candidate_ = {};
    candidate_.add(time_s, value, sd, config_.memory_s);
  }

  void adopt(double time_s) {
    average_ = candidate_;
    support(time_s);
  }

  void support(double time_s) {
    support_s_ = time_s;
    disagrees_since_s_.reset();
    candidate_ = {};
    resumed_ = false;
  }

  Config config_;
  std::optional<Estimate> survey_;
  Average average_, candidate_;
  std::optional<double> first_s_, support_s_, disagrees_since_s_;
  std::optional<double> moved_;
  bool resumed_ = false;
  Vector distance_ = Vector::Zero();
};

}  // namespace ols::sensors
