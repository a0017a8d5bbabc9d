// How often tracklets of different objects agree by chance, as if two stations saw one object: from
// the tracklets that turned out to be no target's. Pure.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

class Clutter {
 public:
  // A tracklet's bearing that no target takes, one that may be a target's (it is clutter if it ends
  // so), and one that a target takes: it is no clutter.
  void unclaimed(const BearingMeasurement& measurement) { note(measurement, false); }
  void undecided(const BearingMeasurement& measurement) { note(measurement, true); }
  void claimed(const BearingMeasurement& measurement);
  // The expected number a day of pairs of objects, one of each station, whose lines of sight agree
  // for so long.
  double pairs_a_day(const std::string& a, const std::string& b, double agreed_s) const;
  int pairs_of_stations() const;
  // The expected number a day of such pairs that are published as targets, for the whole site,
  // where no third station looks: those that agree for agreed_s, of each pair of stations at most
  // so many.
  double published_a_day(double agreed_s, double most_of_a_pair) const;

 private:
  struct Tracklet {
    std::int64_t first_us = 0, last_us = 0;
    double elevation_rad = 0.0;
    Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
    bool is_undecided = false;
  };
  struct Station {
    std::int64_t since_us = 0, now_us = 0;
    double variance = 0.0;                  // of a bearing, on one axis [rad^2]
    std::map<std::int64_t, Tracklet> open;  // by the station's id
    std::deque<Tracklet> ended;
  };
  // Of a station's clutter.
  struct Density {
    double born_per_s = 0.0, life_s = 0.0, present = 0.0;
    double height_rad = 0.0;     // of the region in which it appears
    double rate_variance = 0.0;  // of one axis
  };
  static Density density_of(const Station& station);
  void note(const BearingMeasurement& measurement, bool is_undecided);

  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
