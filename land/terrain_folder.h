// Reads and writes the folder that `ols-land import` makes: land.json, coverings.json and one file
// of heights for each grid. Grids are memory-mapped; their checksums are verified once.
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
  // The first digits of the manifest's SHA-256. So the version changes whenever anything in the
  // folder does.
  std::string version;
  std::shared_ptr<const Terrain> terrain;
};

// Throws std::runtime_error with the file and the reason: it is missing, damaged, of the wrong
// length or of another version. The checksum of a large grid takes seconds: after `stop` no further
// grid is begun, and std::runtime_error says so.
TerrainFolder read_terrain_folder(const std::string& path, const std::stop_token& stop = {});

// The folder that a configuration names in [land]; without one there is no terrain. Throws
// ConfigError, which names the key, for what read_terrain_folder() refuses.
TerrainFolder read_configured_land(const std::string& folder);
// Quick, for folders of any size: reads the manifest, and compares the lengths of the files of
// heights, not their checksums. Throws ConfigError as above.
Manifest check_configured_land(const std::string& folder);

// One grid to write; write_terrain_folder() sets `file` and `sha256` of `form`.
struct NewGrid {
  GridFile form;
  std::vector<float> heights_m;  // in the order of HeightGrid
};

// Creates the folder, which must not exist; it appears completely or not at all. Throws
// std::runtime_error.
void write_terrain_folder(const std::string& path, Manifest manifest,
                          const std::vector<NewGrid>& grids,
                          const std::vector<Covering>& coverings);

// Converts a stored grid to the form that the surface reads.
HeightGrid height_grid(const GridFile& form, std::span<const float> heights_m);

}  // namespace ols::land
