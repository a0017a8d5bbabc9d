// The world of one run: the scenario, and its errors drawn from a seed. Pure; the same seed gives
// the same world.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/sight.h"
#include "sim/ptu/unit.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/seeds.h"

namespace ols::sim {

struct StationTruth {
  std::string id;
  // The geometry in the station's configuration, with its sigmas. After a stationing, it is the
  // stationing's result.
  StationGeometry nominal;
  StationGeometry truth;  // the true geometry; the unit's own errors (gears, axes) are in `unit`
  UnitTruth unit;
  // Of a zoom lens: the truth and its calibration.
  std::optional<ZoomTruth> zoom;
  std::vector<ZoomPoint> zoom_points;
  double clock_offset_s = 0.0;  // the station's UTC minus true UTC
  double clock_sd_s = 0.0;
  double brightness_gain = 1.0;
};

struct TargetTruth {
  Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_ecef = Eigen::Vector3d::Zero();
};

class World {
 public:
  World(const Scenario& scenario, std::uint64_t seed);

  const Scenario& scenario() const { return scenario_; }
  std::uint64_t seed() const { return seed_; }
  const std::vector<StationTruth>& stations() const { return stations_; }
  const LocalFrame& site() const { return site_; }
  // Null if the land is flat and hides nothing.
  const Relief* relief() const { return relief_ ? &*relief_ : nullptr; }
  Eigen::Vector3d camera_enu(std::size_t station) const { return cameras_enu_.at(station); }
  // Whether the land hides a place from a station's camera.
  bool hides(std::size_t station, const Eigen::Vector3d& p_ecef) const;

  // time_s: true time since the scenario's start.
  TargetTruth target(std::size_t index, double time_s) const;

  PtuUnitConfig ptu_unit_config() const;

 private:
  Scenario scenario_;
  std::uint64_t seed_;
  LocalFrame site_;
  std::optional<Relief> relief_;
  std::vector<StationTruth> stations_;
  std::vector<Eigen::Vector3d> cameras_enu_;  // of the stations, in the site's frame
};

}  // namespace ols::sim
