#include "geometry/utm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols {
namespace {

// On the central meridian of zone 33 the easting is 500 km, the scale 0.9996 and grid north true.
TEST(Utm, CentralMeridian) {
  const UtmPoint point = utm_from_geodetic({radians(49.0), radians(15.0), 0.0});
  EXPECT_EQ(point.position.zone, 33);
  EXPECT_TRUE(point.position.northern);
  EXPECT_NEAR(point.position.easting_m, 500e3, 1e-6);
  EXPECT_NEAR(point.scale, 0.9996, 1e-12);
  EXPECT_NEAR(point.convergence_rad, 0.0, 1e-12);
}

// Convergence is, to first order, the longitude from the central meridian times sin(latitude):
// east of it, in the north, grid north is east of true north.
TEST(Utm, ConvergenceEastOfTheCentralMeridian) {
  const UtmPoint point = utm_from_geodetic({radians(49.2), radians(16.6), 0.0});
  EXPECT_NEAR(point.convergence_rad, radians(1.6) * std::sin(radians(49.2)), 1e-5);
}

TEST(Utm, ThereAndBack) {
  for (const double latitude_deg : {-60.0, -0.5, 35.0, 80.0}) {
    const Geodetic place{radians(latitude_deg), radians(179.2), 250.0};
    const Geodetic back = geodetic_from_utm(utm_from_geodetic(place).position, 250.0);
    EXPECT_NEAR(back.latitude_rad, place.latitude_rad, 1e-14);
    EXPECT_NEAR(wrap_pi(back.longitude_rad - place.longitude_rad), 0.0, 1e-14);
    EXPECT_EQ(back.height_m, 250.0);
  }
}

TEST(Utm, RefusesWhatIsNotInAZone) {
  EXPECT_THROW(geodetic_from_utm({0, true, 500e3, 5e6}, 0.0), std::invalid_argument);
  EXPECT_THROW(geodetic_from_utm({61, true, 500e3, 5e6}, 0.0), std::invalid_argument);
  EXPECT_THROW(geodetic_from_utm({33, true, 5e6, 5e6}, 0.0), std::invalid_argument);
  EXPECT_THROW(utm_from_geodetic({radians(89.0), 0.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace ols
