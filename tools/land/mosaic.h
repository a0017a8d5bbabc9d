// The files of elevation models joined: what lies on one lattice becomes one grid, and what does
// not join is found.
#pragma once

#include <string>
#include <vector>

#include "land/terrain_folder.h"
#include "tools/land/elevation_reader.h"

namespace ols::land {

struct Mosaic {
  std::vector<NewGrid> grids;      // the finest first
  std::vector<std::string> notes;  // how files differ where they meet
};

// `rasters`: heights above the ellipsoid, 1-sigma `sd_m`. Where two files have the same place, the
// first counts. Throws std::runtime_error naming two files and a place if they differ there by more
// than three sigmas on the whole, or (`accept_seams`) notes it.
Mosaic join(const std::vector<Raster>& rasters, double sd_m, bool accept_seams);

}  // namespace ols::land
