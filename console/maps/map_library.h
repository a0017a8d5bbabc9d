// The users' own maps in one folder: maps made of pictures, and accuracy maps. The folder is listed
// again at each request. A damaged map is reported, and does not affect the others. Use it in one
// thread only; the thread must be one that may wait for a disk.
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
  // `folder`: empty if there are no maps.
  explicit MapLibrary(std::string folder) : folder_(std::move(folder)) {}

  // The answer to a browser: the list of maps, a tile, or an accuracy map.
  WebResponse answer(const MapTask& task);

  static constexpr std::size_t kMostMaps = 32;

 private:
  struct Entry {
    std::unique_ptr<TileStore> store;        // a map of pictures; otherwise null
    std::unique_ptr<AccuracyFile> accuracy;  // an accuracy map; if this is null, too, the map
                                             // cannot be used
    std::string problem;                     // empty: no problem
    std::int64_t changed_ns = 0;             // time when the file was changed last
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
