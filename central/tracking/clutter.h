// Estimates how often two stations' tracklets of different objects agree by chance, and look like
// one object. The estimate is computed from the clutter: the tracklets that did not become targets.
// Pure.
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
  // Each of these three functions takes a bearing of a tracklet. unclaimed: no track takes the
  // bearing. undecided: a tentative track takes the bearing, or the bearing is ambiguous; if the
  // tracklet ends in this state, it was clutter. claimed: a target takes the bearing; the tracklet
  // is not clutter.
  void unclaimed(const BearingMeasurement& measurement) { note(measurement, false); }
  void undecided(const BearingMeasurement& measurement) { note(measurement, true); }
  void claimed(const BearingMeasurement& measurement);
  // The expected number per day of chance pairs: two objects, one seen by each of these stations,
  // whose lines of sight agree for agreed_s.
  double pairs_a_day(const std::string& a, const std::string& b, double agreed_s) const;
  int pairs_of_stations() const;
  // The expected number per day of chance pairs that the whole site publishes as targets, if no
  // third station looks there. The sum of pairs_a_day() over all pairs of stations, in which each
  // pair counts at most `most_of_a_pair`.
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
    double variance = 0.0;                  // variance of a bearing, on one axis [rad^2]
    std::map<std::int64_t, Tracklet> open;  // by the station's own id
    std::deque<Tracklet> ended;
  };
  // The density of one station's clutter.
  struct Density {
    double new_per_s = 0.0, life_s = 0.0, present = 0.0;
    double height_rad = 0.0;     // height of the region of the sky in which it appears
    double rate_variance = 0.0;  // variance of the rate, on one axis
  };
  static Density density_of(const Station& station);
  void note(const BearingMeasurement& measurement, bool is_undecided);

  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
