// A map in a PMTiles archive (pmtiles_directory.h). The console reads the archive and serves its
// tiles like those of any other map. Therefore a browser needs neither range requests nor a PMTiles
// library.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "console/maps/pmtiles_directory.h"
#include "console/maps/tile_store.h"

namespace ols::console {

class Pmtiles : public TileStore {
 public:
  // Throws std::runtime_error; the message says what is wrong.
  explicit Pmtiles(const std::string& path);
  const MapInfo& info() const override { return header_.info; }
  std::optional<std::string> tile(const TileAddress& address) override;

 private:
  struct Close {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  std::string read(std::uint64_t offset, std::uint64_t bytes, std::uint64_t most) const;
  std::vector<PmtilesEntry> directory(std::uint64_t offset, std::uint64_t bytes) const;

  std::unique_ptr<std::FILE, Close> file_;
  PmtilesHeader header_;
  std::vector<PmtilesEntry> root_, leaf_;
  std::uint64_t leaf_offset_ = 0;  // position in the archive of leaf_, the leaf directory read
                                   // last; 0: none was read
};

// Decompresses gzip. Throws std::runtime_error if the data are damaged or larger than `most`.
std::string gunzipped(const std::string& bytes, std::size_t most);

}  // namespace ols::console
