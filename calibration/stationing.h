// Stationing (paper section 4.2): "the precise heading must be estimated visually by observing the
// distinctive landmarks". Sightings of places with known positions determine a station's heading.
// They also correct the tilt (which an inclinometer has measured) and the camera's mounting (which
// rectification has measured).
//
// The method is maximum a posteriori. The heading has no prior. Tilts, mounting and position have
// priors with the station's stated 1-sigmas. The position is a nuisance parameter: the resulting
// station keeps its old position, and the improved position is a separate result. For lines of
// sight at the horizon, a turn of the mounting about z has the same effect as a change of the
// heading. Only their sum is observable there, and only their sum is needed.
//
// The adjustment is tested by geodetic methods (W. Baarda, A Testing Procedure for Use in Geodetic
// Networks, 1968; P. Teunissen, Testing Theory). First, data snooping finds mistaken landmarks
// (calibration/mistaken_landmarks.h). Then the global test detects stated 1-sigmas that are too
// small.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// The sighting of a landmark in a station's image. The 1-sigmas of pixel and angles must not be
// zero. Sightings with exactly the same landmark_ecef belong to one landmark, and share the error
// of its coordinates.
struct LandmarkSighting {
  // [m] For example from the land register.
  Eigen::Vector3d landmark_ecef = Eigen::Vector3d::Zero();
  double landmark_sd_m = 0.0;  // 1-sigma of each axis
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double pixel_sd_px = 0.0;  // 1-sigma of each coordinate
  PanTilt angles;            // as the PTU reports them
  double angles_sd_rad = 0.0;
};

// Thrown for a sighting that cannot be used.
class LandmarkRefused : public std::invalid_argument {
 public:
  LandmarkRefused(std::size_t sighting, const std::string& field, const std::string& why)
      : std::invalid_argument("stationing: sighting " + std::to_string(sighting + 1) + ": " +
                              field + ": " + why),
        sighting_(sighting),
        field_(field),
        why_(why) {}
  std::size_t sighting() const { return sighting_; }
  // The faulty field: landmark, pixel, angles or deviation.
  const std::string& field() const { return field_; }
  const std::string& why() const { return why_; }

 private:
  std::size_t sighting_;
  std::string field_, why_;
};

// One explanation of a contradiction: without the rejected sightings, all others agree.
struct StationingAlternative {
  std::vector<std::size_t> rejected;
  double heading_rad = 0.0;
};

// Thrown if some landmarks must be mistaken, but the sightings do not show which ones.
class LandmarksContradict : public Contradiction {
 public:
  LandmarksContradict(const std::string& why, std::vector<StationingAlternative> alternatives,
                      std::vector<std::size_t> failing = {})
      : Contradiction("stationing: " + why),
        why_(why),
        alternatives_(std::move(alternatives)),
        failing_(std::move(failing)) {}
  const std::string& why() const { return why_; }
  // At most five, most likely first.
  const std::vector<StationingAlternative>& alternatives() const { return alternatives_; }
  // If there are no alternatives: the sightings that contradict each other or the stated pose.
  const std::vector<std::size_t>& failing() const { return failing_; }

 private:
  std::string why_;
  std::vector<StationingAlternative> alternatives_;
  std::vector<std::size_t> failing_;
};

// In the order heading, tilt x, tilt y, mount z, mount x, mount y of ChainParameters.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

// The w-test of a landmark: tests all its sightings together against the other landmarks.
struct LandmarkTest {
  std::vector<std::size_t> sightings;
  bool rejected = false;
  // The root of a chi-square with 2 degrees of freedom per sighting. If w exceeds `critical`, the
  // landmark counts as mistaken.
  double w = 0.0;
  double critical = 0.0;
  // The minimal detectable bias (power 80 %): a shift of the landmark across and up, as seen from
  // the station. Infinite if the other landmarks do not check this one. A shift along the line of
  // sight is not detectable.
  Eigen::Vector2d detectable_m = Eigen::Vector2d::Zero();
};

// The 1-sigma of the elevation of a line of sight at the horizon, in one azimuth.
struct HorizonSd {
  double azimuth_rad = 0.0;
  double elevation_sd_rad = 0.0;
};

struct Stationing {
  // The geometry with the adjusted chain. The remaining errors of heading, tilts and mounting are
  // strongly correlated; separate 1-sigmas cannot express this. `station.sd` therefore puts the
  // errors of direction into heading and tilts, and `station.sd.mount_rad` is zero. The 1-sigmas of
  // heading and tilts are the smallest that cover the error of every line of sight within
  // `highest_rad` of the horizon. `station.sd.mount_roll_rad` is the adjusted roll's own 1-sigma.
  StationGeometry station;
  // [rad^2] Includes the variance factor if the global test rejects the stated 1-sigmas.
  PoseCovariance covariance = PoseCovariance::Zero();
  // Each sighting's residual (cross-elevation, elevation), divided by its 1-sigma.
  std::vector<Eigen::Vector2d> residuals;
  std::vector<Eigen::Vector2d> residuals_rad;
  std::vector<LandmarkTest> landmarks;
  ModelTest global;
  // The w-test of each prior (tilt x, tilt y, mount z, mount x, mount y, east, north, up). If the
  // prior is right, the value is standard normal. 0 for a prior whose 1-sigma is zero.
  std::array<double, 8> stated_w{};
  double scaled_by = 1.0;  // factor by which the global test has enlarged the 1-sigmas
  // The station's position, improved by the landmarks, and the 1-sigma of its worst axis.
  Geodetic position;
  double position_sd_m = 0.0;
  // The azimuths in which the landmarks determine the tilt best and worst.
  HorizonSd best, worst;
};

// Throws std::invalid_argument if there are no sightings, or if the landmarks do not determine the
// heading to 10 degrees. Throws LandmarkRefused if a sighting is not finite, is outside the lens
// model, or shows a landmark at the station itself. Throws LandmarksContradict if it is ambiguous
// which landmarks are mistaken.
Stationing station_by_landmarks(const StationGeometry& rough,
                                std::span<const LandmarkSighting> sightings, double highest_rad,
                                const Levels& levels = {});

}  // namespace ols::calibration
