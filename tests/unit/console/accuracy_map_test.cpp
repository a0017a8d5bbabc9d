#include "console/accuracy_map.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

Json station(double latitude_deg, double longitude_deg) {
  return {
      {"latitude_deg", latitude_deg},     {"longitude_deg", longitude_deg}, {"height_m", 300.0},
      {"position_sd_m", {0.1, 0.1, 0.1}}, {"heading_sd_deg", 0.02},         {"tilt_sd_deg", 0.01},
      {"field_of_view_deg", {6.0, 4.0}},  {"image_px", {1280, 960}}};
}

constexpr const char* kBox = "?box=16.59,49.22,16.61,49.24&above=100";

TEST(AccuracyMap, IsBestBetweenTheStationsAndWorstFarAway) {
  const Json stations{station(49.225, 16.594), station(49.225, 16.606), station(49.235, 16.60)};
  const auto map = accuracy_map(stations, kBox);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->at("height_m"), 400.0);
  const auto cell = [&](int row, int column) {
    return map->at("sd_m")
        .at(static_cast<std::size_t>(row * kAccuracyCells + column))
        .get<double>();
  };
  EXPECT_EQ(map->at("sd_m").size(), static_cast<std::size_t>(kAccuracyCells * kAccuracyCells));
  EXPECT_GT(cell(22, 20), 0.05);
  EXPECT_LT(cell(22, 20), 1.0);
  EXPECT_GT(cell(0, 0), cell(22, 20)) << "the north-western corner";
}

TEST(AccuracyMap, OneStationOrSilentOnesDetermineNothing) {
  Json stations{station(49.225, 16.594), station(49.225, 16.606)};
  stations[0]["stale"] = true;
  const auto map = accuracy_map(stations, kBox);
  ASSERT_TRUE(map);
  for (const Json& sd : map->at("sd_m")) EXPECT_TRUE(sd.is_null());
}

TEST(AccuracyMap, WhatIsUnknownOfAStationStopsNothing) {
  Json stations{station(49.225, 16.594), station(49.225, 16.606), {{"latitude_deg", nullptr}}};
  stations[0]["heading_sd_deg"] = nullptr;
  stations[1]["position_sd_m"] = {nullptr, nullptr, nullptr};
  EXPECT_TRUE(accuracy_map(stations, kBox)->at("sd_m").at(800).is_number());
}

TEST(AccuracyMap, RefusesWhatIsNoBox) {
  for (const char* query :
       {"", "?box=1,2,3&above=1", "?box=16,49,17,50", "?box=17,49,16,50&above=1",
        "?box=10,40,20,50&above=1", "?box=16,49,17,50&above=1e9"}) {
    EXPECT_FALSE(accuracy_map(Json::array(), query)) << query;
  }
}

}  // namespace
}  // namespace ols::console
