// A map in a folder of pictures: ZOOM/COLUMN/ROW.png (or .jpg, .jpeg, .webp). Rows are counted from
// the north.
#pragma once

#include <string>

#include "console/maps/tile_store.h"

namespace ols::console {

class TileFolder : public TileStore {
 public:
  // Throws std::runtime_error if the folder has no zoom level.
  explicit TileFolder(const std::string& path);
  const MapInfo& info() const override { return info_; }
  std::optional<std::string> tile(const TileAddress& address) override;

 private:
  std::string path_, suffix_;  // suffix_: that of the picture found last
  MapInfo info_;
};

}  // namespace ols::console
