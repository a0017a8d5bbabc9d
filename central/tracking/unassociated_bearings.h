// The recent bearings that belong to no track, by station. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "central/measurement/bearing_measurement.h"
#include "central/measurement/place_axes.h"

namespace ols::fusion {

// A compact copy of a bearing's data for a quick check.
struct BearingSummary {
  std::int64_t utime_us = 0;
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
  double spread_rad = 0.0;  // upper bound of the angle to its target; generous
  double clock_sd_s = 0.0;
  std::int64_t track_id = 0;
  bool is_tracklet = false;

  // Whether the bearing points at this position, to within spread_rad plus more_rad.
  bool is_near(const Eigen::Vector3d& p_ecef, double more_rad) const;
};
// R_ecef_enu: the east-north-up axes at the bearing's origin (geometry/wgs84.h).
BearingSummary summarise(const BearingMeasurement& measurement, const Eigen::Matrix3d& R_ecef_enu);

class UnassociatedBearings {
 public:
  // One station's bearings and their summaries, both in order of time and of the same length.
  struct Station {
    std::deque<BearingMeasurement> bearings;
    std::vector<BearingSummary> looks;

    BearingSummary look(const BearingMeasurement& measurement) {
      return summarise(measurement, axes_.R_ecef_enu(measurement.sight.origin_ecef));
    }

   private:
    PlaceAxes axes_;
  };

  // A bearing is kept until its station has a bearing that is newer by span_s, or has `most` newer
  // bearings.
  UnassociatedBearings(double span_s, int most)
      : span_s_(span_s), most_(static_cast<std::size_t>(most)) {}

  void store(const BearingMeasurement& measurement);
  void erase_if(const std::string& station,
                const std::function<bool(const BearingMeasurement&)>& condition);
  void forget(const std::string& station) { stations_.erase(station); }
  // By station; no entry is empty.
  const std::map<std::string, Station>& stations() const { return stations_; }

 private:
  double span_s_;
  std::size_t most_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
