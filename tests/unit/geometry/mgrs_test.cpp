#include "geometry/mgrs.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols {
namespace {

std::string at(double latitude_deg, double longitude_deg, int digits) {
  return mgrs({radians(latitude_deg), radians(longitude_deg), 0.0}, digits);
}

// The examples of GeographicLib's GeoConvert(1).
TEST(Mgrs, NamesPlacesAsGeoConvertDoes) {
  EXPECT_EQ(at(33.3, 44.4, 2), "38SMB4484");
  EXPECT_EQ(at(33.3, 44.4, 0), "38SMB");
  EXPECT_EQ(at(33.3, 44.4, 5).size(), 15U);
}

TEST(Mgrs, HasSquaresAtThePolesToo) { EXPECT_EQ(at(89.9, 0.0, 0), "ZAG"); }

TEST(Mgrs, RefusesWhatIsNoPlace) {
  EXPECT_THROW(at(91.0, 0.0, 5), std::invalid_argument);
  EXPECT_THROW(at(std::numeric_limits<double>::quiet_NaN(), 0.0, 5), std::invalid_argument);
}

}  // namespace
}  // namespace ols
