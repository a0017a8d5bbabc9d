#include "central/measurement/place_axes.h"

#include <gtest/gtest.h>

#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

TEST(PlaceAxes, AreThoseOfEachPlaceInTurn) {
  const Eigen::Vector3d here = ecef_from_geodetic({0.86, 0.29, 250.0});
  const Eigen::Vector3d there = ecef_from_geodetic({0.87, 0.29, 250.0});
  PlaceAxes axes;
  for (const Eigen::Vector3d& place : {here, here, there, here}) {
    EXPECT_EQ(axes.R_ecef_enu(place), R_ecef_enu(place));
  }
}

}  // namespace
}  // namespace ols::fusion
