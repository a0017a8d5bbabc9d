// The unknowns of an adjustment: the parameters of every station, UT1, the angles of every shared
// pose, and the nuisance of every block.
//
// The global parameters form one vector: kStationParameters for each station, then UT1 - UTC, then
// pan and tilt of each shared pose.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/parameters.h"

namespace ols::calibration {

// What is known about a station before the adjustment.
struct StationPrior {
  StationModel model;
  double refraction = 0.13;
  double air = 1.0;
  // The covariance of the parameters, in the units of geometry/station_model.h; 0 for a parameter
  // that is known exactly. The covariance of the heading is ignored: the heading counts as unknown.
  StationMatrix covariance = StationMatrix::Zero();
  double pose_sd_rad = 0.0;  // 1-sigma of each angle of a pose; independent at every pose
};

struct StationState {
  StationModel model;
  double refraction = 0.0;
  double air = 1.0;
  StationVector change = StationVector::Zero();  // from the prior
};

struct State {
  std::vector<StationState> stations;
  double ut1_s = 0.0;  // correction of UT1 - UTC
  std::vector<Eigen::Vector2d> poses;
  std::vector<Eigen::VectorXd> nuisances;  // for each block
};

// Where the parameters are in the vector of the global parameters: the first index of a station's
// parameters, the index of UT1, and the first index of a pose's angles.
struct Layout {
  std::size_t stations = 0, poses = 0;
  int station(std::size_t i) const { return static_cast<int>(i) * kStationParameters; }
  int ut1() const { return station(stations); }
  int pose(std::size_t i) const { return ut1() + 1 + 2 * static_cast<int>(i); }
  int size() const { return pose(poses); }
};

StationState station_at(const StationPrior& prior, const StationVector& change);

// The station's GROUND frame (east, north, up).
inline LocalFrame frame_of(const StationState& station) {
  return LocalFrame(station.model.geometry.position);
}

}  // namespace ols::calibration
