#include "edge/station/borders.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::station {
namespace {

ChainParameters north() { return {}; }

mount::Limits limits() {
  mount::Limits limits;
  limits.pan_min_rad = radians(-90.0);
  limits.pan_max_rad = radians(90.0);
  limits.tilt_min_rad = radians(-20.0);
  limits.tilt_max_rad = radians(40.0);
  return limits;
}

TEST(Borders, TheTravelGoesRoundFromItsLeastPanAndTilt) {
  const auto found = borders(north(), limits(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].is_keep_out);
  // Positive pan turns left: the least pan is in the east.
  EXPECT_NEAR(degrees(found[0].outline[0].azimuth_rad), 90.0, 1e-9);
  EXPECT_NEAR(degrees(found[0].outline[0].elevation_rad), -20.0, 1e-9);
  EXPECT_NEAR(degrees(found[0].outline[1].azimuth_rad), 45.0, 1e-9);
  EXPECT_NEAR(degrees(found[0].outline[4].azimuth_rad), 270.0, 1e-9);
  EXPECT_NEAR(degrees(found[0].outline[8].elevation_rad), 40.0, 1e-9);
  EXPECT_NEAR(degrees(found[0].outline[14].elevation_rad), 10.0, 1e-9);
}

TEST(Borders, AKeepOutRegionIsCutAtTheTravel) {
  mount::Limits of_unit = limits();
  of_unit.keep_out = {{radians(-120.0), radians(-60.0), radians(0.0), radians(80.0)},
                      {radians(100.0), radians(120.0), radians(0.0), radians(10.0)}};
  const auto found = borders(north(), of_unit, true);
  ASSERT_EQ(found.size(), 2U) << "the second region lies outside of the travel";
  EXPECT_TRUE(found[1].is_keep_out);
  EXPECT_NEAR(degrees(found[1].outline[0].azimuth_rad), 90.0, 1e-9);
  EXPECT_NEAR(degrees(found[1].outline[4].azimuth_rad), 60.0, 1e-9);
  EXPECT_NEAR(degrees(found[1].outline[8].elevation_rad), 40.0, 1e-9);
}

TEST(Borders, AreDirectionsOfTheAxisAsItIsMounted) {
  ChainParameters chain;
  chain.heading_rad = radians(30.0);
  chain.mount_z_rad = radians(2.0);
  const auto found = borders(chain, limits(), true);
  EXPECT_NEAR(degrees(found[0].outline[0].azimuth_rad), 118.0, 0.2);
}

TEST(Borders, AnUnknownTravelIsNotShown) { EXPECT_TRUE(borders(north(), limits(), false).empty()); }

}  // namespace
}  // namespace ols::station
