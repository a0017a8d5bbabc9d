// The folder of `ols-land import` on disk: land.json, coverings.json and one file of heights for
// each grid. Grids are mapped, not read; their sums are checked once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "land/manifest.h"
#include "land/terrain.h"

namespace ols::land {

struct TerrainFolder {
  Manifest manifest;
  std::string version;  // the first digits of the manifest's SHA-256: it changes with any content
  std::shared_ptr<const Terrain> terrain;
};

// Throws std::runtime_error naming the file and what is wrong: one is missing, damaged, of another
// length or of another version.
TerrainFolder read_terrain_folder(const std::string& path);

// One grid to write: `file` and `sha256` of `form` are filled in.
struct NewGrid {
  GridFile form;
  std::vector<float> heights_m;  // as in HeightGrid
};

// Makes the folder, which must not exist; it appears whole or not at all. Throws
// std::runtime_error.
void write_terrain_folder(const std::string& path, Manifest manifest,
                          const std::vector<NewGrid>& grids,
                          const std::vector<Covering>& coverings);

// The grid as the surface reads it.
HeightGrid height_grid(const GridFile& form, std::span<const float> heights_m);

}  // namespace ols::land
