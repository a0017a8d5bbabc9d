#include "console/maps/mbtiles.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/console/maps/map_folder.h"

namespace ols::console {
namespace {

std::string trouble(const std::string& path) {
  try {
    Mbtiles map(path);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(Mbtiles, GivesTilesWithRowsFromTheNorth) {
  const MapFolder folder;
  folder.write_mbtiles("a.mbtiles");
  Mbtiles map(folder.path("a.mbtiles"));
  EXPECT_EQ(map.info().name, "Orthophoto");
  EXPECT_EQ(map.info().attribution, "the survey");
  EXPECT_EQ(map.info().min_zoom, 2);
  EXPECT_EQ(map.info().bounds_deg[2], 17.0);
  EXPECT_EQ(map.tile({2, 1, 1}), kPng);
  EXPECT_FALSE(map.tile({2, 1, 2}));
  EXPECT_EQ(map.tile({2, 1, 1}), kPng) << "again";
}

TEST(Mbtiles, SaysWhatIsWrongWithAFile) {
  const MapFolder folder;
  EXPECT_EQ(trouble(folder.path("none.mbtiles")), "unable to open database file");
  folder.write("text.mbtiles", std::string(5000, 'x'));
  EXPECT_EQ(trouble(folder.path("text.mbtiles")), "file is not a database");
  folder.write("empty.mbtiles", "");
  EXPECT_EQ(trouble(folder.path("empty.mbtiles")), "no such table: metadata");
  folder.write_mbtiles("vector.mbtiles", "INSERT INTO metadata VALUES ('format', 'pbf');");
  EXPECT_EQ(trouble(folder.path("vector.mbtiles")),
            "holds vector tiles; only maps of pictures are shown");
}

TEST(Mbtiles, ADamagedPageIsSaidWhenItIsRead) {
  const MapFolder folder;
  folder.write_mbtiles("a.mbtiles", "", kPng + std::string(20'000, 'p'));
  std::fstream file(folder.path("a.mbtiles"), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(2 * 4096);
  file << std::string(4096, '\xff');
  file.close();
  Mbtiles map(folder.path("a.mbtiles"));
  EXPECT_THROW(map.tile({2, 1, 1}), std::runtime_error);
}

TEST(Mbtiles, AQueryWithoutEndIsGivenUp) {
  const MapFolder folder;
  folder.write_mbtiles(
      "a.mbtiles",
      "DROP TABLE tiles; CREATE VIEW tiles AS WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i "
      "+ "
      "1 FROM n) SELECT 2 AS zoom_level, 1 AS tile_column, 1 AS tile_row, i AS tile_data FROM n "
      "WHERE i < 0;");
  Mbtiles map(folder.path("a.mbtiles"));
  EXPECT_THROW(map.tile({2, 1, 2}), std::runtime_error);
}

}  // namespace
}  // namespace ols::console
