#include "console/maps/tile_folder.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/console/maps/map_folder.h"

namespace ols::console {
namespace {

TEST(TileFolder, HasPicturesOfAnyKind) {
  const MapFolder folder;
  folder.write("3/1/2.png", "a");
  folder.write("7/5/6.jpg", "b");
  folder.write("notes/readme.txt", "c");
  TileFolder map(folder.path());
  EXPECT_EQ(map.info().min_zoom, 3);
  EXPECT_EQ(map.info().max_zoom, 7);
  EXPECT_EQ(map.tile({3, 1, 2}), "a");
  EXPECT_EQ(map.tile({7, 5, 6}), "b");
  EXPECT_FALSE(map.tile({7, 5, 5}));
}

TEST(TileFolder, WithoutZoomLevelsIsNone) {
  const MapFolder folder;
  folder.write("notes/readme.txt", "c");
  EXPECT_THROW(TileFolder(folder.path()), std::runtime_error);
}

}  // namespace
}  // namespace ols::console
