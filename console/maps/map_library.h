// The users' own maps, of pictures and of accuracy: every one in a folder, looked for again when
// they are asked for. A damaged one is said, and leaves the others alone. For one thread, which may
// wait for a disk.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "console/maps/accuracy_file.h"
#include "console/maps/tile_store.h"
#include "console/web_api.h"

namespace ols::console {

class MapLibrary {
 public:
  // An empty name: there are no maps.
  explicit MapLibrary(std::string folder) : folder_(std::move(folder)) {}

  // The answer to a browser: the list of maps, a tile, or a map of the accuracy.
  WebResponse answer(const MapTask& task);

  static constexpr std::size_t kMostMaps = 32;

 private:
  struct Entry {
    std::unique_ptr<TileStore> store;        // of pictures,
    std::unique_ptr<AccuracyFile> accuracy;  // or this; without either it cannot be used
    std::string problem;                     // empty: none
    std::int64_t changed_ns = 0;             // the file's
  };
  void look();
  void open(const std::string& name, std::int64_t changed_ns);
  WebResponse list();
  WebResponse tile(const MapTask& task);
  WebResponse accuracy(const MapTask& task) const;

  std::string folder_, folder_problem_;
  std::map<std::string, Entry> maps_;  // by the name of the file or folder
};

}  // namespace ols::console
