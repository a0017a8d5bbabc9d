// Goes along one azimuth outwards from a camera, and records the visible land as a staircase
// (land/staircase.h).
#pragma once

#include <vector>

#include "geometry/wgs84.h"
#include "land/staircase.h"
#include "land/surface.h"

namespace ols::land {

struct MarchSettings {
  double reach_m = 0.0;  // horizontal distance at which the march ends
  double least_cell_m = 0.0;
  double cell_per_distance = 0.0;  // length of a cell, relative to its distance from the camera
  double refraction_k = 0.0;
  double refraction_k_sd = 0.0;  // 1-sigma
  // The surface is lowered by this amount at the camera. The amount decreases with distance, to
  // zero at kLowered_m.
  double lowered_m = 0.0;
  // Whether the camera is below a roof or tree-tops. If so, the roof or wood above the camera is
  // ignored as far as its edge.
  bool covered = false;
};

// The distance over which the error of an elevation model stays about the same. In common models
// this is a few samples.
inline constexpr double kLowered_m = 300.0;

// Adds the steps of this azimuth to `steps`. Returns the distance [m] up to which the surface is
// known without interruption; reach_m if it is known all the way.
double march(const Surface& surface, const LocalFrame& frame, double azimuth_rad,
             const MarchSettings& settings, std::vector<Step>& steps);

}  // namespace ols::land
