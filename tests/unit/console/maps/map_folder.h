// A folder of maps that exists as long as this object.
#pragma once

#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace ols::console {

inline const std::string kPng = std::string("\x89PNG\r\n\x1a\n") + "a tile";

class MapFolder {
 public:
  MapFolder() { std::filesystem::create_directories(path_); }
  ~MapFolder() { std::filesystem::remove_all(path_); }
  MapFolder(const MapFolder&) = delete;
  MapFolder& operator=(const MapFolder&) = delete;

  std::string path(const std::string& name = "") const { return (path_ / name).string(); }
  void write(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << bytes;
  }
  // Writes an MBTiles file with one tile, at zoom level 2, in column 1 and the second row from the
  // north.
  void write_mbtiles(const std::string& name, const std::string& more = "",
                     const std::string& tile = kPng) const {
    sqlite3* database = nullptr;
    sqlite3_open(path(name).c_str(), &database);
    std::string hex;
    for (const unsigned char byte : tile) {
      constexpr const char* kDigits = "0123456789abcdef";
      hex += kDigits[byte >> 4U];
      hex += kDigits[byte & 15U];
    }
    const std::string text =
        "CREATE TABLE metadata (name text, value text);"
        "CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data "
        "blob);"
        "INSERT INTO metadata VALUES ('name', 'Orthophoto'), ('minzoom', '2'), ('maxzoom', '5'),"
        "('bounds', '16.0,49.0,17.0,50.0'), ('attribution', 'the survey');"
        "INSERT INTO tiles VALUES (2, 1, 2, x'" +
        hex + "');" + more;
    sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr);
    sqlite3_close(database);
  }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                ("ols_maps_" + std::to_string(::getpid()) + "_" +
                                 std::to_string(reinterpret_cast<std::uintptr_t>(this)));
};

}  // namespace ols::console
