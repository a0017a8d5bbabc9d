// The skylines that the stations have seen. They contain obstacles that the model of the land
// lacks: trees, cranes, houses. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "land/seen_skyline.h"

namespace ols::fusion {

// One sector of a station's skyline.
struct SkylineSector {
  std::string station;
  // When the station began this skyline; a new value voids earlier sectors.
  std::int64_t begun_us = 0;
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  bool heading_disagrees = false;  // the skyline does not fit the station's heading
  int sector = 0;
  std::vector<land::SeenSkyline::Column> columns;
};

class SeenSkylines {
 public:
  // Returns whether the station has begun this skyline since its last sector.
  bool take(const SkylineSector& sector);
  // The station's skyline. Null if none is known from this camera position, or if it does not fit
  // the station's heading.
  const land::SeenSkyline* of(const std::string& station, const Eigen::Vector3d& camera_ecef) const;
  // The probability that the seen skyline does not hide a target with this covariance [m^2, ECEF];
  // 1 where the skyline is unknown.
  double visibility(const std::string& station, const Eigen::Vector3d& camera_ecef,
                    const Eigen::Vector3d& target_ecef,
                    const Eigen::Matrix3d& covariance_ecef) const;
  void forget(const std::string& station) { skylines_.erase(station); }
  void clear() { skylines_.clear(); }

  static constexpr double kMoved_m = 5.0;  // the same as SkylineWatch::kMoved_m of the station

 private:
  struct Known {
    std::int64_t begun_us = 0;
    Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
    bool heading_disagrees = false;
    land::SeenSkyline crests;
  };
  std::map<std::string, Known> skylines_;  // by station
};

}  // namespace ols::fusion
