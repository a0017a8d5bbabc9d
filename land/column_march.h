// Along one azimuth outwards from a camera: what of the land is seen, as a staircase.
#pragma once

#include <vector>

#include "geometry/wgs84.h"
#include "land/staircase.h"
#include "land/surface.h"

namespace ols::land {

struct MarchSettings {
  double reach_m = 0.0;  // horizontal
  double least_cell_m = 0.0;
  double cell_per_distance = 0.0;
  double refraction_k = 0.0;
  double refraction_k_sd = 0.0;  // 1-sigma
  // The surface lies lower by this at the camera, and by less up to kLowered_m away.
  double lowered_m = 0.0;
  // A roof or tree-tops are above the camera: they are left out up to their edge.
  bool covered = false;
};

// How far an error of an elevation model is the same: some samples of the usual models.
inline constexpr double kLowered_m = 300.0;

// Adds the azimuth's steps. Gives the distance where the surface has its first gap, or ends [m].
double march(const Surface& surface, const LocalFrame& frame, double azimuth_rad,
             const MarchSettings& settings, std::vector<Step>& steps);

}  // namespace ols::land
