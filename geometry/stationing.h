// Stationing (paper section 4.2): "the precise heading must be estimated visually by observing the
// distinctive landmarks". From sightings of places whose positions are known, the heading of a
// station, and what they add to what the inclinometer and the rectification know of its tilt and of
// its camera's mounting.
//
// Maximum a posteriori: nothing is known of the heading; tilts, mounting and position have the
// station's stated deviations as priors. The position is not changed, it is only not known exactly.
// A turn of the mounting about the vertical looks like a heading; only the sum shows at the
// horizon, and only the sum is needed there.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/sight.h"

namespace ols {

// A landmark in a station's picture. A pixel and angles without any error are refused.
struct LandmarkSighting {
  Eigen::Vector3d landmark_ecef = Eigen::Vector3d::Zero();  // [m] as the land register has it
  double landmark_sd_m = 0.0;                               // of each axis
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double pixel_sd_px = 0.0;  // of each coordinate
  PanTilt angles;            // as the PTU reports them
  double angles_sd_rad = 0.0;
};

// heading, tilt x, tilt y, mount z, mount x, mount y of ChainParameters.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

struct Stationing {
  // With the chain as found. Its sd gives to the heading and the tilts alone what is left of the
  // mounting: the least deviations that cover every line of sight no farther than `highest_rad`
  // from the horizon. What is left is strongly correlated, and deviations alone cannot say that.
  StationGeometry station;
  PoseCovariance covariance = PoseCovariance::Zero();  // [rad^2]
  // Of each sighting, (cross-elevation, elevation) over its deviation: a landmark that was mistaken
  // for another stands out.
  std::vector<Eigen::Vector2d> residuals;
};

// std::invalid_argument for no sighting; naming it, for one that is not finite or of a landmark at
// the station; and where the landmarks leave the heading unknown (10 degrees).
Stationing station_by_landmarks(const StationGeometry& rough,
                                std::span<const LandmarkSighting> sightings, double highest_rad);

}  // namespace ols
