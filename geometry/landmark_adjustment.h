// The least-squares adjustment of geometry/stationing.h: of a station's pose, by any choice of the
// sighted landmarks, linearised for all of them.
//
// A landmark is all sightings of one place: what its coordinates are off is common to them, so that
// sighting it twice makes it no better known.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/sight.h"
#include "geometry/stationing.h"

namespace ols {

// The pose's six angles (heading, tilt x, tilt y, mount z, mount x, mount y), then the position:
// east, north, up. Each over its stated deviation, the heading over a milliradian.
inline constexpr int kPoseUnknowns = 9;
using PoseUnknowns = Eigen::Matrix<double, kPoseUnknowns, 1>;
using PoseInformation = Eigen::Matrix<double, kPoseUnknowns, kPoseUnknowns>;

// What a landmark's sightings say at a pose, with W the inverse of their covariance, J their
// Jacobian and v their residuals.
struct LandmarkEquations {
  PoseInformation information = PoseInformation::Zero();  // J^T W J
  PoseUnknowns gradient = PoseUnknowns::Zero();           // J^T W v
  double squares = 0.0;                                   // v^T W v
  // Of a shift of the landmark by one radian as seen from the station, across and up: s is 1 in
  // each sighting.
  double shift_information = 0.0;                       // s^T W s
  Eigen::Matrix<double, kPoseUnknowns, 2> shift_pose =  // J^T W s
      Eigen::Matrix<double, kPoseUnknowns, 2>::Zero();
};

// A pose by some of the landmarks, and what all of them say there.
struct LandmarkFit {
  std::vector<bool> kept;  // by landmark
  PoseUnknowns unknowns = PoseUnknowns::Zero();
  StationGeometry station;
  PoseInformation information = PoseInformation::Zero();
  double misfit = 0.0;  // of the kept and of the stated deviations: chi-square with `redundancy`
  int redundancy = 0;
  std::vector<LandmarkEquations> landmarks;
};

class LandmarkAdjustment {
 public:
  // Refuses sightings as station_by_landmarks does.
  LandmarkAdjustment(const StationGeometry& rough, std::span<const LandmarkSighting> sightings);

  const std::vector<std::vector<std::size_t>>& landmarks() const { return landmarks_; }
  // The heading at which the landmark's first sighting meets it.
  double heading_by(std::size_t landmark) const;
  LandmarkFit fit(const std::vector<bool>& kept, double heading_rad) const;
  // One deviation of each unknown: 0 where it is known.
  const PoseUnknowns& scale() const { return scale_; }
  // Of a sighting at a pose [rad], (across, up) by which the measured line misses the landmark.
  Eigen::Vector2d residual(const StationGeometry& station, std::size_t sighting) const;
  double deviation_rad(std::size_t sighting) const;  // of a residual's components
  double distance_m(std::size_t sighting) const;

 private:
  using Residuals = Eigen::Matrix<double, Eigen::Dynamic, 2>;

  PoseUnknowns linearise(LandmarkFit& fit, bool also_others) const;
  LandmarkEquations equations(const StationGeometry& at, const std::vector<StationGeometry>& beside,
                              std::size_t landmark) const;
  std::vector<StationGeometry> beside(const PoseUnknowns& unknowns) const;
  Residuals residuals(const StationGeometry& station, std::size_t landmark) const;
  Residuals weighted(const Residuals& residuals, std::size_t landmark) const;

  StationGeometry rough_;
  std::vector<LandmarkSighting> sightings_;
  std::vector<Eigen::Vector3d> rays_cam_;
  std::vector<double> distances_m_;
  std::vector<std::vector<std::size_t>> landmarks_;  // the sightings of each
  PoseUnknowns scale_;
};

// The station with its pose changed by what the unknowns are worth.
StationGeometry changed(const StationGeometry& station, const PoseUnknowns& by);

}  // namespace ols
