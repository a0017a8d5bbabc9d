// A map in an MBTiles file (github.com/mapbox/mbtiles-spec 1.3): an SQLite database with the tables
// metadata and tiles. Rows are counted from the south. Only maps of pictures can be read, no vector
// tiles.
#pragma once

#include <sqlite3.h>

#include <memory>
#include <string>

#include "console/maps/tile_store.h"

namespace ols::console {

class Mbtiles : public TileStore {
 public:
  // Throws std::runtime_error; the message says what is wrong.
  explicit Mbtiles(const std::string& path);
  const MapInfo& info() const override { return info_; }
  std::optional<std::string> tile(const TileAddress& address) override;

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
    void operator()(sqlite3_stmt* query) const { sqlite3_finalize(query); }
  };
  using Query = std::unique_ptr<sqlite3_stmt, Close>;
  Query prepare(const char* text) const;
  [[noreturn]] void fail() const;
  void read_metadata();

  std::unique_ptr<sqlite3, Close> database_;
  Query tile_;
  MapInfo info_;
};

}  // namespace ols::console
