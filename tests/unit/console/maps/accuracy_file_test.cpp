#include "console/maps/accuracy_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/console/maps/map_folder.h"
#include "tests/unit/error_text.h"

namespace ols::console {
namespace {

Json ring(double west) {
  return {{west, 49.0}, {west + 1.0, 49.0}, {west + 1.0, 50.0}, {west, 50.0}, {west, 49.0}};
}

// As ols-precision writes it.
Json cell(double above_m = 50.0, double horizontal_m = 0.3, double up_m = 0.4) {
  return {{"type", "Feature"},
          {"geometry", {{"type", "Polygon"}, {"coordinates", Json::array({ring(16.0)})}}},
          {"properties",
           {{"above_stations_m", above_m}, {"horizontal_m", horizontal_m}, {"up_sd_m", up_m}}}};
}

Json station() {
  return {{"type", "Feature"},
          {"geometry", {{"type", "Point"}, {"coordinates", {16.0, 49.0, 250.0}}}},
          {"properties", {{"station", "alfa"}}}};
}

std::string file(const std::vector<Json>& features) {
  return Json{{"type", "FeatureCollection"}, {"features", features}}.dump();
}

std::string problem(const std::string& text) {
  return error_text<std::exception>([&] { accuracy_cells(text); });
}

TEST(AccuracyFile, HasTheCellsOfEachHeightWithTheRootOfTheirTrace) {
  const Json read =
      accuracy_cells(file({station(), cell(100.0), cell(50.0), cell(50.0, 1.2, 0.5)}));
  const Json& heights = read.at("heights");
  ASSERT_EQ(heights.size(), 2U);
  EXPECT_EQ(heights[0].at("above_m"), 50.0);
  EXPECT_EQ(heights[1].at("above_m"), 100.0);
  ASSERT_EQ(heights[0].at("cells").size(), 2U);
  EXPECT_EQ(heights[0].at("cells")[0], Json({0.5, 16.0, 49.0, 17.0, 49.0, 17.0, 50.0, 16.0, 50.0}));
  EXPECT_EQ(heights[0].at("cells")[1][0], 1.3);
}

TEST(AccuracyFile, ACellAcrossTheDateLineHasTwoParts) {
  Json both = cell();
  both["geometry"] = {{"type", "MultiPolygon"},
                      {"coordinates", {Json::array({ring(179.0)}), Json::array({ring(-180.0)})}}};
  EXPECT_EQ(accuracy_cells(file(std::vector{both})).at("heights")[0].at("cells").size(), 2U);
}

TEST(AccuracyFile, WhatIsWrongIsSaidWithTheFeature) {
  using testing::HasSubstr;
  EXPECT_THAT(problem("[1"), HasSubstr("no GeoJSON"));
  EXPECT_THAT(problem("{\"type\": \"FeatureCollection\"}"), HasSubstr("no GeoJSON"));
  EXPECT_THAT(problem(file(std::vector{station()})), HasSubstr("no cell with a deviation"));
  EXPECT_THAT(problem(file({cell(), 7})), HasSubstr("feature 2: is no feature"));
  for (const char* key : {"above_stations_m", "horizontal_m", "up_sd_m"}) {
    Json without = cell();
    without["properties"][key] = "much";
    EXPECT_EQ(problem(file({station(), without})),
              "feature 2: " + std::string(key) + " is missing or no number");
  }
  Json away = cell();
  away["geometry"]["coordinates"][0][1][0] = 181.0;
  EXPECT_THAT(problem(file(std::vector{away})), HasSubstr("no place on Earth"));
  away["geometry"]["coordinates"][0] = Json::array({{16.0, 49.0}, {17.0, 49.0}});
  EXPECT_THAT(problem(file(std::vector{away})), HasSubstr("no polygon"));
  away["geometry"].erase("coordinates");
  EXPECT_THAT(problem(file(std::vector{away})), HasSubstr("no coordinates"));
  away.erase("geometry");
  EXPECT_THAT(problem(file(std::vector{away})), HasSubstr("no geometry"));
  Json bare = cell();
  bare.erase("properties");
  EXPECT_THAT(problem(file(std::vector{bare})), HasSubstr("no properties"));
}

TEST(AccuracyFile, MoreThanABrowserDrawsIsRefused) {
  std::vector<Json> heights;
  for (int i = 0; i < 30; ++i) heights.push_back(cell(10.0 * i));
  EXPECT_EQ(problem(file(heights)), "has more than 20 heights");
}

TEST(AccuracyFile, IsReadOnceAndKnowsItsHeights) {
  const MapFolder folder;
  folder.write("plan.geojson", file({cell(30.0), cell(100.0)}));
  const AccuracyFile read(folder.path("plan.geojson"));
  EXPECT_EQ(read.heights_m(), Json({30.0, 100.0}));
  EXPECT_EQ(Json::parse(read.body()).at("heights").size(), 2U);
  EXPECT_THROW(AccuracyFile(folder.path("none.geojson")), std::exception);
}

}  // namespace
}  // namespace ols::console
