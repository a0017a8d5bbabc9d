// The header and the directories of a PMTiles archive, version 3
// (github.com/protomaps/PMTiles/blob/main/spec/v3/spec.md). Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "console/maps/tile_store.h"

namespace ols::console {

inline constexpr std::size_t kPmtilesHeaderBytes = 127;

struct PmtilesHeader {
  std::uint64_t root_offset = 0, root_bytes = 0;      // of the root directory
  std::uint64_t leaves_offset = 0, leaves_bytes = 0;  // of the leaf directories
  std::uint64_t tiles_offset = 0, tiles_bytes = 0;
  bool is_gzipped = false;  // whether the directories are gzipped
  MapInfo info;             // without the name
};
// Throws std::runtime_error; the message says what is wrong.
PmtilesHeader parse_pmtiles_header(std::span<const std::uint8_t> bytes);

struct PmtilesEntry {
  std::uint64_t tile = 0;    // number of the first tile
  std::uint64_t offset = 0;  // from the start of the tiles; for a leaf directory, from the start of
                             // the leaf directories
  std::uint32_t bytes = 0;
  std::uint32_t run = 0;  // number of consecutive tiles with the same content; 0: the entry is a
                          // leaf directory
};
// Reads a decompressed directory. Throws std::runtime_error.
std::vector<PmtilesEntry> parse_pmtiles_directory(std::span<const std::uint8_t> bytes);
// The entry of a tile, or of the leaf directory in which the tile's entry must be; nullopt:
// neither.
std::optional<PmtilesEntry> find_tile(const std::vector<PmtilesEntry>& directory,
                                      std::uint64_t tile);
// The number of a tile. Tiles are numbered zoom level after zoom level, and along a Hilbert curve
// within each.
std::uint64_t tile_number(const TileAddress& address);

}  // namespace ols::console
