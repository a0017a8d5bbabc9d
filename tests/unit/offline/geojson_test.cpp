#include "tools/offline/geojson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "geometry/angles.h"
#include "tests/unit/error_text.h"
#include "tests/unit/temp_dir.h"

namespace ols::offline {
namespace {

class GeoJson : public testing::Test {
 protected:
  GeoShapes read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_geojson(path_);
  }
  std::string why_not(const std::string& text) const {
    return error_text<GeoJsonError>([&] { read(text); });
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::string path_ = temp_dir() + "geojson_test_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".geojson";
};

// A square of 0.2 degrees about a meridian, with a hole of half its size.
std::string square(double west, double east, double hole_west, double hole_east) {
  std::ostringstream text;
  const auto ring = [&](double w, double e, double half) {
    text << "[[" << w << ',' << -half << "],[" << e << ',' << -half << "],[" << e << ',' << half
         << "],[" << w << ',' << half << "],[" << w << ',' << -half << "]]";
  };
  text << R"({"type":"Polygon","coordinates":[)";
  ring(west, east, 0.1);
  text << ',';
  ring(hole_west, hole_east, 0.05);
  text << "]}";
  return text.str();
}

TEST_F(GeoJson, AnAreaOverTheDateLineIsAsOneElsewhere) {
  const auto here = read(square(9.9, 10.1, 9.95, 10.05)).polygons;
  for (const auto& text :
       {square(179.9, -179.9, 179.95, -179.95), square(179.9, -179.9, -180.05 + 360.0, -179.95)}) {
    const auto there = read(text).polygons;
    ASSERT_EQ(there.size(), 1U);
    for (double d = -0.15; d < 0.15; d += 0.0101) {
      for (const double latitude : {-0.07, 0.01, 0.2}) {
        const double longitude = std::remainder(180.0 + d, 360.0);
        EXPECT_EQ(contains(there[0], longitude, latitude), contains(here[0], 10.0 + d, latitude))
            << d << ", " << latitude;
      }
    }
    const auto expected = fill(here, 1000.0, 50.0), points = fill(there, 1000.0, 50.0);
    ASSERT_GT(expected.size(), 200U);
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LE(std::abs(points[i].longitude_rad), kPi);
      EXPECT_NEAR(std::remainder(points[i].longitude_rad - expected[i].longitude_rad, 2.0 * kPi),
                  radians(170.0), 1e-9);
      EXPECT_NEAR(points[i].latitude_rad, expected[i].latitude_rad, 1e-12);
    }
  }
}

TEST_F(GeoJson, RefusesARingRoundAPole) {
  const std::string why =
      why_not(R"({"type":"Polygon","coordinates":[[[0,80],[120,80],[-120,80],[0,80]]]})");
  EXPECT_NE(why.find("a ring must not go round a pole"), std::string::npos) << why;
  EXPECT_EQ(why.find(path_), 0U) << why;
}

}  // namespace
}  // namespace ols::offline
