// The probability that a target made of tracklets exists: a ghost is missing from images that
// should show it. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// An image that should show a target does show it with a probability of 0.8. At the place of a
// ghost it shows something with a probability of 0.4, because a ghost's lines of sight belong to
// real objects.
class Existence {
 public:
  // Starts judging, with a probability of 0.5. Until then the target counts as certain. A target
  // not made of tracklets is never judged.
  void begin() { is_judged_ = true; }
  void seen();
  // visible: the probability that nothing hid the target. If the target is hidden, a miss proves
  // nothing.
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
  // Whether the position is well inside the image of this bearing. False unless the camera has
  // recently stood still.
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
