#include "base/config/area.h"

#include <gtest/gtest.h>

namespace ols {
namespace {

TEST(Area, ContainsItsBorders) {
  constexpr Area kArea{49.0, 16.0, 50.0, 17.0};
  EXPECT_TRUE(is_inside(kArea, 49.0, 17.0));
  EXPECT_TRUE(is_inside(kArea, 49.5, 16.5));
  EXPECT_FALSE(is_inside(kArea, 50.1, 16.5));
  EXPECT_FALSE(is_inside(kArea, 48.9, 16.5));
  EXPECT_FALSE(is_inside(kArea, 49.5, 15.9));
  EXPECT_FALSE(is_inside(kArea, 49.5, 17.1));
}

TEST(Area, MayLieAcrossTheDateLine) {
  constexpr Area kArea{-20.0, 179.0, -10.0, -179.0};
  EXPECT_TRUE(is_inside(kArea, -15.0, 179.5));
  EXPECT_TRUE(is_inside(kArea, -15.0, -179.5));
  EXPECT_FALSE(is_inside(kArea, -15.0, 0.0));
}

}  // namespace
}  // namespace ols
