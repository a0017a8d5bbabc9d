#include "geometry/geodesic.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols {
namespace {

Geodetic place(double latitude_deg, double longitude_deg) {
  return {radians(latitude_deg), radians(longitude_deg), 0.0};
}

// Flinders Peak to Buninyong: the example of the Geocentric Datum of Australia's technical manual,
// on GRS80, which differs from WGS84 by 0.1 mm here.
TEST(Geodesic, AgreesWithAPublishedLine) {
  const Geodesic line = geodesic_between(
      place(-(37 + 57 / 60.0 + 3.72030 / 3600), 144 + 25 / 60.0 + 29.52440 / 3600),
      place(-(37 + 39 / 60.0 + 10.15610 / 3600), 143 + 55 / 60.0 + 35.38390 / 3600));
  EXPECT_NEAR(line.distance_m, 54972.271, 0.002);
  EXPECT_NEAR(degrees(line.azimuth_rad), 306 + 52 / 60.0 + 5.37 / 3600, 1e-5);
}

TEST(Geodesic, FromNorthClockwise) {
  EXPECT_NEAR(degrees(geodesic_between(place(0, 0), place(0, 1)).azimuth_rad), 90.0, 1e-9);
  EXPECT_NEAR(degrees(geodesic_between(place(0, 0), place(0, -1)).azimuth_rad), 270.0, 1e-9);
  EXPECT_NEAR(geodesic_between(place(0, 0), place(0, 1)).distance_m, 111319.4908, 1e-3);
}

}  // namespace
}  // namespace ols
