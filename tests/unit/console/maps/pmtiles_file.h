// Makes PMTiles archives, byte by byte.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/console/maps/map_folder.h"

namespace ols::console {

inline std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 127; value >>= 7U) bytes += static_cast<char>((value & 127U) | 128U);
  return bytes + static_cast<char>(value);
}

struct PmtilesRow {
  std::uint64_t tile, run, bytes, offset;
};

inline std::string pmtiles_directory(const std::vector<PmtilesRow>& rows) {
  std::string bytes = varint(rows.size());
  std::uint64_t before = 0;
  for (const auto& row : rows) {
    bytes += varint(row.tile - before);
    before = row.tile;
  }
  for (const auto& row : rows) bytes += varint(row.run);
  for (const auto& row : rows) bytes += varint(row.bytes);
  for (const auto& row : rows) bytes += varint(row.offset + 1);
  return bytes;
}

inline std::string little_endian_bytes(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

// An archive of header, root directory, leaf directories and tiles. `compression` of the
// directories: 1: none, 2: gzip.
inline std::string pmtiles_archive(const std::string& root, const std::string& leaves,
                                   const std::string& tiles, int compression = 1,
                                   int tile_type = 2) {
  const std::uint64_t root_at = 127, leaves_at = root_at + root.size(),
                      tiles_at = leaves_at + leaves.size();
  std::string header = "PMTiles\x03";
  for (const std::uint64_t number :
       {root_at, std::uint64_t{root.size()}, root_at, std::uint64_t{0}, leaves_at,
        std::uint64_t{leaves.size()}, tiles_at, std::uint64_t{tiles.size()}}) {
    header += little_endian_bytes(number, 8);
  }
  header += std::string(24, '\0');  // counts
  header += '\x01';                 // clustered
  header += static_cast<char>(compression);
  header += '\x01';  // compression of the tiles: none
  header += static_cast<char>(tile_type);
  header += std::string("\x02\x05", 2);  // zoom levels
  for (const int degrees : {16, 49, 17, 50}) {
    header += little_endian_bytes(static_cast<std::uint64_t>(degrees) * 10'000'000, 4);
  }
  header += std::string(127 - header.size(), '\0');
  return header + root + leaves + tiles;
}

}  // namespace ols::console
