// Estimates the error of a station's heading, by comparing the seen skyline with the skyline of the
// land. Pure.
//
// The model of their difference at one azimuth:
//
//   seen - modelled elevation = slope * heading error          (shifts the skyline sideways)
//     + level, tilt towards east and north                     (of the station)
//     + offset of the camera in the model: east, north, up     (its effect is divided by distance)
//     + refraction
//     + error of the model of the land + error of the pictures
//
// The error of the model of the land has the sigma that the land states. Along one crest, this
// error stays about the same for land::kLowered_m; on different ridges, it is independent.
// Therefore, further pictures of the same crest add little information, but pictures of other
// crests add much. The error is treated as a first-order Markov process along the skyline. This
// allows an exact least-squares solution for all unknowns, in a time proportional to the number of
// places.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/skyline/seen_horizon.h"
#include "land/horizon_map.h"

namespace ols::skyline {

struct SkylineHeading {
  double error_rad = 0.0;  // the station's heading minus the skyline's
  double sd_rad = 0.0;     // 1-sigma; includes the error of the model of the land
  // By how much the camera is higher above the land than the station states, from the pictures
  // alone: place_enu_m.z() of the prior is not used.
  double higher_m = 0.0, higher_sd_m = 0.0;
};

// 1-sigma of the station's own errors before anything is seen. While little has been seen, these
// priors keep the estimate within the range that find_skyline() searches.
struct StationSd {
  double heading_rad = kHeadingSd_rad, tilt_rad = kTiltSd_rad;
  // 1-sigma of the camera's place in the model of the land (east, north, up). It contains the
  // station's position error and a shift of the whole model.
  Eigen::Vector3d place_enu_m = Eigen::Vector3d::Zero();
};

// nullopt if too little has been seen, or if the solution does not converge.
std::optional<SkylineHeading> skyline_heading(const std::vector<SeenPlace>& seen,
                                              const land::HorizonMap& map,
                                              const StationSd& station);

}  // namespace ols::skyline
