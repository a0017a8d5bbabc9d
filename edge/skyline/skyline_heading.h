// The error of a station's heading, estimated from the skyline that the station has seen and the
// skyline of the land. Pure.
//
// The difference between the two, at one azimuth:
//
//   seen - modelled elevation = slope * heading error          (turns the skyline sideways)
//     + level, tilt towards east and north                     (of the station)
//     + offset of the camera in the model: east, north, up     (its effect is divided by distance)
//     + refraction
//     + error of the model there + error of the pictures
//
// The model's error has the sigma that the land states. Along one crest it stays about the same for
// land::kLowered_m; on different ridges it is independent. Therefore many pictures of one crest
// tell little more than one picture, but a whole horizon tells much more. The error is modelled as
// a first-order Markov process along the skyline. The unknowns are therefore solved for together
// and exactly, in time proportional to the number of places.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/skyline/seen_horizon.h"
#include "land/horizon_map.h"

namespace ols::skyline {

struct SkylineHeading {
  double error_rad = 0.0;  // the station's heading minus the skyline's
  double sd_rad = 0.0;     // 1-sigma, the model's error included
};

// 1-sigma of the station's own errors before anything is seen. While little has been seen, these
// keep the estimate within the range in which the finder looks.
struct StationSd {
  double heading_rad = kHeadingSd_rad, tilt_rad = kTiltSd_rad;
  // Of the camera's place in the model (east, north, up). It contains the station's position error
  // and a shift of the whole model.
  Eigen::Vector3d place_enu_m = Eigen::Vector3d::Zero();
};

// nullopt if too little has been seen.
std::optional<SkylineHeading> skyline_heading(const std::vector<SeenPlace>& seen,
                                              const land::HorizonMap& map,
                                              const StationSd& station);

}  // namespace ols::skyline
