// The least-squares adjustment behind geometry/stationing.h: fits a station's pose to any subset of
// the sighted landmarks, linearised for all of them.
//
// A landmark groups all sightings of one place. They share the error of its coordinates, which
// repeated sightings do not average out.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/sight.h"
#include "geometry/stationing.h"

namespace ols {

// The six angles of the pose (heading, tilt x, tilt y, mount z, mount x, mount y), then the
// position (east, north, up). Each is divided by its stated deviation, the heading by a
// milliradian.
inline constexpr int kPoseUnknowns = 9;
using PoseUnknowns = Eigen::Matrix<double, kPoseUnknowns, 1>;
using PoseInformation = Eigen::Matrix<double, kPoseUnknowns, kPoseUnknowns>;

// The normal equations of a landmark's sightings at a pose. W is the inverse of their covariance, J
// their Jacobian, v their residuals.
struct LandmarkEquations {
  PoseInformation information = PoseInformation::Zero();  // J^T W J
  PoseUnknowns gradient = PoseUnknowns::Zero();           // J^T W v
  double squares = 0.0;                                   // v^T W v
  // For a shift of the landmark by one radian as seen from the station, across and up: s is 1 in
  // each sighting.
  double shift_information = 0.0;                       // s^T W s
  Eigen::Matrix<double, kPoseUnknowns, 2> shift_pose =  // J^T W s
      Eigen::Matrix<double, kPoseUnknowns, 2>::Zero();
};

// A pose fitted to the kept landmarks, and the equations of all landmarks at that pose.
struct LandmarkFit {
  std::vector<bool> kept;  // by landmark
  PoseUnknowns unknowns = PoseUnknowns::Zero();
  StationGeometry station;
  PoseInformation information = PoseInformation::Zero();
  double misfit = 0.0;  // of kept landmarks and priors: chi-square with `redundancy`
  int redundancy = 0;
  std::vector<LandmarkEquations> landmarks;
};

class LandmarkAdjustment {
 public:
  // Refuses the same sightings as station_by_landmarks.
  LandmarkAdjustment(const StationGeometry& rough, std::span<const LandmarkSighting> sightings);

  const std::vector<std::vector<std::size_t>>& landmarks() const { return landmarks_; }
  // The heading at which the landmark's first sighting hits it.
  double heading_by(std::size_t landmark) const;
  LandmarkFit fit(const std::vector<bool>& kept, double heading_rad) const;
  // The standard deviation of each unknown; 0 if it is known exactly.
  const PoseUnknowns& scale() const { return scale_; }
  // The angles by which the sighting's line of sight misses the landmark [rad]: (across, up).
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
  std::vector<std::vector<std::size_t>> landmarks_;  // the sightings of each landmark
  PoseUnknowns scale_;
};

// The station with its pose changed by the unknowns.
StationGeometry changed(const StationGeometry& station, const PoseUnknowns& by);

}  // namespace ols
