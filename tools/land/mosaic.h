// Joins the files of elevation models: files on one lattice become one grid. Finds files whose
// heights contradict each other.
#pragma once

#include <string>
#include <vector>

#include "land/terrain_folder.h"
#include "tools/land/elevation_reader.h"

namespace ols::land {

struct Mosaic {
  std::vector<NewGrid> grids;      // the finest first
  std::vector<std::string> notes;  // differences between files where they meet
};

// `rasters`: heights above the ellipsoid, with 1-sigma `sd_m`. Where files of one lattice overlap,
// the first is used. If two files or grids differ on average by more than three sigmas where they
// meet or overlap, throws std::runtime_error naming both files and a place; with `accept_seams`
// this is only noted.
Mosaic join(const std::vector<Raster>& rasters, double sd_m, bool accept_seams);

}  // namespace ols::land
