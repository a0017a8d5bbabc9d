// The skylines that the stations have seen, and what hides targets there in addition to the model
// of the land. Pure.
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
  std::int64_t begun_us =
      0;  // when this skyline began; with another value, earlier sectors are void
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  bool heading_disagrees = false;  // the station disputes its heading
  int sector = 0;
  std::vector<land::SeenSkyline::Column> columns;
};

class SeenSkylines {
 public:
  void take(const SkylineSector& sector);
  // Null if none is known from this place, or if the station's heading disagrees with the land.
  const land::SeenSkyline* of(const std::string& station, const Eigen::Vector3d& camera_ecef) const;
  // The probability that what the station has seen does not hide a target with this covariance
  // [m^2, ECEF]; 1 where nothing is known.
  double visibility(const std::string& station, const Eigen::Vector3d& camera_ecef,
                    const Eigen::Vector3d& target_ecef,
                    const Eigen::Matrix3d& covariance_ecef) const;
  void forget(const std::string& station) { skylines_.erase(station); }
  void clear() { skylines_.clear(); }

  static constexpr double kMoved_m = 5.0;  // as the station has it: SkylineWatch::kMoved_m

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
