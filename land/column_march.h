// Follows one azimuth outwards from a camera and records the visible land as a staircase.
#pragma once

#include <vector>

#include "geometry/wgs84.h"
#include "land/staircase.h"
#include "land/surface.h"

namespace ols::land {

struct MarchSettings {
  double reach_m = 0.0;  // horizontal distance at which the march ends
  double least_cell_m = 0.0;
  double cell_per_distance = 0.0;
  double refraction_k = 0.0;
  double refraction_k_sd = 0.0;  // 1-sigma
  // The surface is lowered by this amount at the camera, and by less with growing distance, down to
  // nothing at kLowered_m.
  double lowered_m = 0.0;
  // The camera is below a roof or tree-tops; these are ignored as far as their edge.
  bool covered = false;
};

// The distance over which the error of an elevation model stays about the same. In the usual models
// it is a few samples.
inline constexpr double kLowered_m = 300.0;

// Adds the azimuth's steps to `steps`. Returns the distance at which the surface ends or has its
// first gap [m].
double march(const Surface& surface, const LocalFrame& frame, double azimuth_rad,
             const MarchSettings& settings, std::vector<Step>& steps);

}  // namespace ols::land
