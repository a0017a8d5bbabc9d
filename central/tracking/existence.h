// How probable it is that a target of tracklets exists: ghosts miss in images that should show
// them. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// An image that should show a target has it with probability 0.8; it has something at the place of
// a ghost with 0.4, because a ghost's lines of sight are those of real objects.
class Existence {
 public:
  // As likely as not. Before that, and so for a target without tracklets, it is certain.
  void begin() { is_judged_ = true; }
  void seen();
  void missed();
  bool is_judged() const { return is_judged_; }
  double probability() const;

 private:
  bool is_judged_ = false;
  double log_odds_ = 0.0;
};

// Where the stations' cameras look, as their statuses state it.
class StationViews {
 public:
  // view_rad: the narrower field of view.
  void know(const std::string& station, const AzimuthElevation& axis, double view_rad,
            std::int64_t utime_us);
  // Whether the image of this bearing has the place well inside: the camera stood still lately.
  bool shows(const BearingMeasurement& in_image, const Eigen::Vector3d& p_ecef) const;
  void forget(const std::string& station) { views_.erase(station); }

 private:
  struct View {
    AzimuthElevation axis;
    double view_rad = 0.0;
    std::int64_t utime_us = 0;
    bool is_steady = false;  // since the status before
  };
  std::map<std::string, View> views_;
};

}  // namespace ols::fusion
