// Stations whose bearings agree with nobody's: a heading that is some degrees off. Pure.
//
// A bearing that no track explains says nothing by itself. A station of which for seconds hardly
// one is explained, while all of them are off the nearest target by the same angle, has a wrong
// pose: it is named, and begins no tracks (its rays would meet the others' in ghosts). Bearings of
// it that are explained are used all the same, and end the quarantine when they become most of
// them. Where there is no target any more the quarantine lapses: the station may have been mended,
// and no target may begin without it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace ols::fusion {

struct PointingConfig {
  double memory_s = 3.0;          // judged over so long
  int least_bearings = 30;        // and not from fewer
  double explained_share = 0.1;   // of which no more are explained
  double released_share = 0.5;    // so many explained, and it is believed again
  double least_off_rad = 0.0035;  // 0.2 deg; smaller errors are biases, which the filter carries
  double most_off_rad = 0.5;      // further off it follows something else
  double spread = 0.25;           // greatest RMS about the mean angle, over that angle
  double lapse_s = 5.0;           // without a target to judge by all is forgotten
};

class PointingMonitor {
 public:
  explicit PointingMonitor(const PointingConfig& config = {}) : config_(config) {}

  // off_rad: from the nearest confirmed target (cross-elevation, elevation); nothing without one.
  void hear(const std::string& station, std::int64_t utime_us, bool explained,
            const std::optional<Eigen::Vector2d>& off_rad);
  // Why a station is quarantined, in words; empty when it is not.
  const std::string& quarantine(const std::string& station) const;
  void forget(const std::string& station) { stations_.erase(station); }
  void clear() { stations_.clear(); }

 private:
  struct Station {
    std::int64_t first_us = 0, newest_us = 0;
    double bearings = 0.0, explained = 0.0;  // decaying
    double judged = 0.0;                     // of those not explained, near a target
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double squared = 0.0;
    std::string quarantine;
  };
  void lapse(const std::string& station, std::int64_t utime_us);
  void judge(Station& station) const;

  PointingConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
