// Reads and writes the folder that `ols-land import` makes: land.json, coverings.json and one file
// of heights for each grid. Grids are memory-mapped; their checksums are verified when the folder
// is read.
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "land/manifest.h"
#include "land/terrain.h"

namespace ols::land {

struct TerrainFolder {
  Manifest manifest;
  // The first digits of the manifest's SHA-256. The manifest has the checksums of the other files;
  // therefore the version changes whenever any file in the folder changes.
  std::string version;
  std::shared_ptr<const Terrain> terrain;
};

// Whether the terrain includes the scenery that stations have measured.
enum class Scenery { kIncluded, kLeftOut };

// Throws std::runtime_error with the file and the reason: the file is missing, damaged, of the
// wrong length or of another version. The checksum of a large grid takes seconds. If a stop is
// requested through `stop`, no further grid is begun, and std::runtime_error says so.
TerrainFolder read_terrain_folder(const std::string& path, Scenery scenery = Scenery::kIncluded,
                                  const std::stop_token& stop = {});

// Reads the folder that a configuration names in [land]; empty: there is no terrain. Throws
// ConfigError naming the key where read_terrain_folder() throws.
TerrainFolder read_configured_land(const std::string& folder);
// Checks such a folder quickly, whatever its size: reads the manifest, and compares the lengths of
// the files of heights, but not their checksums. Throws ConfigError in the same way.
Manifest check_configured_land(const std::string& folder);

// One grid to write. write_terrain_folder() fills the fields `file` and `sha256` of `form`.
struct NewGrid {
  GridFile form;
  std::vector<float> heights_m;  // in the order of HeightGrid
};

// Creates the folder, which must not exist yet. The folder appears completely or not at all. Throws
// std::runtime_error.
void write_terrain_folder(const std::string& path, Manifest manifest,
                          const std::vector<NewGrid>& grids,
                          const std::vector<Covering>& coverings);

// Converts a stored grid to the form that Terrain uses.
HeightGrid height_grid(const GridFile& form, std::span<const float> heights_m);

}  // namespace ols::land
