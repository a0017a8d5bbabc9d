#include "bridge/ownership/cell.h"

#include <gtest/gtest.h>

namespace ols::bridge {
namespace {

constexpr Cell kCell{49.0, 16.0, 50.0, 17.0};

TEST(Cell, DepthIsTheDistanceToTheNearestBorder) {
  EXPECT_NEAR(depth_m(kCell, 49.1, 16.5), 11'119.5, 1.0);
  EXPECT_NEAR(depth_m(kCell, 49.5, 16.1), 7'222.0, 10.0);
  EXPECT_NEAR(depth_m(kCell, 48.9, 16.5), -11'119.5, 1.0);
  EXPECT_NEAR(depth_m(kCell, 49.5, 17.1), -7'222.0, 10.0);
  EXPECT_NEAR(depth_m(kCell, 49.5, 15.9), -7'222.0, 10.0);
}

TEST(Cell, TheWholeWorldHasNoSides) {
  EXPECT_GT(depth_m({-90.0, -180.0, 90.0, 180.0}, 49.0, 179.9999), 1e6);
}

TEST(Cell, MayLieAcrossTheDateLine) {
  const Cell cell{-20.0, 179.0, -10.0, -179.0};
  EXPECT_GT(depth_m(cell, -15.0, 180.0), 1e5);
  EXPECT_GT(depth_m(cell, -15.0, -179.5), 5e4);
  EXPECT_LT(depth_m(cell, -15.0, 178.0), 0.0);
  EXPECT_LT(depth_m(cell, -15.0, -178.0), 0.0);
}

}  // namespace
}  // namespace ols::bridge
