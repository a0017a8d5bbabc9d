// Finds stations whose bearings agree with no target, for example because their heading is some
// degrees off. Pure.
//
// One unexplained bearing proves nothing. A station's pose counts as wrong if, for some seconds,
// targets explain hardly any of its bearings, and all of these bearings miss the nearest target by
// about the same angle. The station is then quarantined: an alarm is raised, and its bearings
// initiate no tracks, because the intersections of its rays with other stations' rays would be
// ghosts. Bearings that a target explains are still used. The quarantine ends when targets explain
// most of the bearings. It also ends after lapse_s without a target: the station may have been
// corrected, and may be needed to initiate a target.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "conditions/alarm.h"

namespace ols::fusion {

struct PointingConfig {
  double memory_s = 3.0;         // time constant of the averages
  int least_bearings = 30;       // smallest number of bearings for a judgement
  double explained_share = 0.1;  // largest share of explained bearings at which a quarantine begins
  double released_share = 0.5;   // smallest share of explained bearings at which it ends
  double least_off_rad = 0.0035;  // 0.2 deg; the filter estimates smaller offsets as biases
  double most_off_rad = 0.5;      // at a larger offset, the station follows another object
  double spread = 0.25;           // largest RMS scatter about the mean offset, relative to the mean
  double lapse_s = 5.0;           // after this time without a target, everything is forgotten
};

class PointingMonitor {
 public:
  explicit PointingMonitor(const PointingConfig& config = {}) : config_(config) {}

  // off_rad: the bearing's offset from the nearest confirmed target (cross-elevation, elevation);
  // nullopt if there is no target.
  void hear(const std::string& station, std::int64_t utime_us, bool explained,
            const std::optional<Eigen::Vector2d>& off_rad);
  // Why a station is quarantined; empty if it is not.
  const Alarm& quarantine(const std::string& station) const;
  void forget(const std::string& station) { stations_.erase(station); }
  void clear() { stations_.clear(); }

 private:
  struct Station {
    std::int64_t first_us = 0, newest_us = 0;
    double bearings = 0.0, explained = 0.0;  // counts that decay with time
    double judged = 0.0;                     // unexplained bearings near a target
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double squared = 0.0;
    Alarm quarantine;
  };
  void lapse(const std::string& station, std::int64_t utime_us);
  void judge(const std::string& name, Station& station) const;

  PointingConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
