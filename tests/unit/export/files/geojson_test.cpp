#include "export/files/geojson.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

TEST(ExportGeoJson, HeightsAreAboveTheEllipsoid) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_target(7, 1'000'000));
  picture.take(made_station());
  picture.take(made_line());
  const auto document = nlohmann::json::parse(geojson(picture, 5000.0));
  const auto& features = document.at("features");
  ASSERT_EQ(features.size(), 4U);
  EXPECT_EQ(features[0].at("geometry").at("coordinates"),
            nlohmann::json::parse("[13.25, 47.5, 100.0]"));
  EXPECT_EQ(features[0].at("properties").at("height_above_sea_m"), 54.0);
  EXPECT_EQ(features[0].at("properties").at("covariance_enu_m2"),
            nlohmann::json::parse("[4.0, 1.0, 0.0, 9.0, 0.0, 25.0]"));
  EXPECT_EQ(features[1].at("geometry").at("type"), "LineString");
  EXPECT_EQ(features[1].at("properties").at("coordTimes"),
            nlohmann::json::parse(R"(["2023-11-14T22:13:20.123Z", "2023-11-14T22:13:21.123Z"])"));
  EXPECT_EQ(features[2].at("properties").at("kind"), "station");
  EXPECT_EQ(features[3].at("properties").at("kind"), "line");
}

TEST(ExportGeoJson, WhatIsUnknownIsNull) {
  Picture picture;
  Target target = made_target();
  target.place.geoid_m = kUnknown;
  target.velocity_enu_m_s.fill(kUnknown);
  picture.take(target);
  const auto properties =
      nlohmann::json::parse(geojson(picture, 1.0)).at("features")[0].at("properties");
  EXPECT_TRUE(properties.at("height_above_sea_m").is_null());
  EXPECT_TRUE(properties.at("speed_m_s").is_null());
}

}  // namespace
}  // namespace ols::exports
