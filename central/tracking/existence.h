// The probability that a target made of tracklets exists. A ghost is missing from many images that
// should show it. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// An image that should show a target does so with a probability of 0.8. An image that should show a
// ghost shows something there with a probability of 0.4, because a ghost's lines of sight belong to
// real objects.
class Existence {
 public:
  // Starts judging, from a probability of 0.5. A target that is not judged has probability 1. Only
  // targets made of tracklets are judged.
  void begin() { is_judged_ = true; }
  void seen();
  // visible: the probability that nothing hides the target in this image. A hidden target's absence
  // from the image proves nothing.
  void missed(double visible = 1.0);
  bool is_judged() const { return is_judged_; }
  double probability() const;

 private:
  bool is_judged_ = false;
  double log_odds_ = 0.0;
};

// The directions in which the stations' cameras look, according to their statuses.
class StationViews {
 public:
  // view_rad: the narrower field of view.
  void know(const std::string& station, const AzimuthElevation& axis, double view_rad,
            std::int64_t utime_us);
  // Whether the position is well inside the image in which this bearing was measured. False if the
  // camera has moved recently.
  bool shows(const BearingMeasurement& in_image, const Eigen::Vector3d& p_ecef) const;
  void forget(const std::string& station) { views_.erase(station); }

 private:
  struct View {
    AzimuthElevation axis;
    double view_rad = 0.0;
    std::int64_t utime_us = 0;
    bool is_steady = false;  // the axis has not moved since the previous status
  };
  std::map<std::string, View> views_;
};

}  // namespace ols::fusion
