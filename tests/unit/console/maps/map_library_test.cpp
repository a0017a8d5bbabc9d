#include "console/maps/map_library.h"

#include <gtest/gtest.h>

#include "tests/unit/console/maps/pmtiles_file.h"

namespace ols::console {
namespace {

Json listed(MapLibrary& library) { return Json::parse(library.answer({}).body).at("maps"); }

TEST(MapLibrary, ListsEveryMapOfAFolder) {
  const MapFolder folder;
  folder.write_mbtiles("photo.mbtiles");
  folder.write("archive.pmtiles",
               pmtiles_archive(pmtiles_directory({{5, 1, kPng.size(), 0}}), "", kPng));
  folder.write("pieces/3/1/2.png", kPng);
  folder.write("notes.txt", "no map");
  MapLibrary library(folder.path());
  const Json maps = listed(library);
  ASSERT_EQ(maps.size(), 3U);
  EXPECT_EQ(maps[0].at("id"), "archive.pmtiles");
  EXPECT_EQ(maps[1].at("name"), "Orthophoto");
  EXPECT_EQ(maps[2].at("zoom"), (Json{3, 3}));
  EXPECT_EQ(library.answer({"photo.mbtiles", {2, 1, 1}}).content_type, "image/png");
  EXPECT_EQ(library.answer({"archive.pmtiles", {2, 0, 0}}).body, kPng);
  EXPECT_EQ(library.answer({"pieces", {3, 1, 2}}).body, kPng);
  EXPECT_EQ(library.answer({"pieces", {3, 1, 1}}).status, 204);
  EXPECT_EQ(library.answer({"../secret", {3, 1, 1}}).status, 404);
}

TEST(MapLibrary, ADamagedMapIsSaidAndLeavesTheOthers) {
  const MapFolder folder;
  folder.write("bad.mbtiles", std::string(5000, 'x'));
  folder.write_mbtiles("good.mbtiles");
  MapLibrary library(folder.path());
  const Json maps = listed(library);
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].at("problem"), "file is not a database");
  EXPECT_EQ(library.answer({"bad.mbtiles", {2, 1, 1}}).status, 404);
  EXPECT_EQ(maps[1].at("problem"), "");
  EXPECT_EQ(library.answer({"good.mbtiles", {2, 1, 1}}).status, 200);
}

TEST(MapLibrary, ATileThatIsNoPictureIsNotPassedOn) {
  const MapFolder folder;
  folder.write_mbtiles("bad.mbtiles", "", "<script>alert(1)</script>");
  MapLibrary library(folder.path());
  EXPECT_EQ(library.answer({"bad.mbtiles", {2, 1, 1}}).status, 500);
  EXPECT_EQ(listed(library)[0].at("problem"), "a tile is neither PNG nor JPEG nor WebP");
}

TEST(MapLibrary, AnAccuracyThatWasComputedAheadIsNoPicture) {
  const MapFolder folder;
  folder.write("plan.geojson", R"({"type": "FeatureCollection", "features": [{
    "type": "Feature",
    "geometry": {"type": "Polygon", "coordinates": [[[16, 49], [17, 49], [17, 50], [16, 49]]]},
    "properties": {"above_stations_m": 50, "horizontal_m": 3, "up_sd_m": 4}}]})");
  folder.write("damaged.geojson", "{");
  MapLibrary library(folder.path());
  const Json maps = listed(library);
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].at("problem"), "is no GeoJSON of ols-precision map");
  EXPECT_EQ(maps[1].at("above_m"), Json({50.0}));
  EXPECT_FALSE(maps[1].contains("zoom"));
  MapTask task{"plan.geojson", {}, true};
  const WebResponse cells = library.answer(task);
  EXPECT_EQ(cells.status, 200);
  EXPECT_EQ(Json::parse(cells.body).at("heights")[0].at("cells")[0][0], 5.0);
  task.map = "damaged.geojson";
  EXPECT_EQ(library.answer(task).status, 404);
  EXPECT_EQ(library.answer({"plan.geojson", {2, 1, 1}}).status, 404) << "it has no tiles";
}

TEST(MapLibrary, MapsMayComeAndGo) {
  const MapFolder folder;
  MapLibrary library(folder.path());
  EXPECT_EQ(listed(library).size(), 0U);
  folder.write_mbtiles("a.mbtiles");
  EXPECT_EQ(listed(library).size(), 1U);
  std::filesystem::remove(folder.path("a.mbtiles"));
  EXPECT_EQ(listed(library).size(), 0U);
}

TEST(MapLibrary, NoFolderIsNoProblem) {
  MapLibrary library("/nowhere/maps");
  const WebResponse response = library.answer({});
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(Json::parse(response.body).at("problem"), "");
}

}  // namespace
}  // namespace ols::console
