#include "console/map_geometry.h"

#include <gtest/gtest.h>

#include <limits>

namespace ols::console {
namespace {

TEST(MapGeometry, TheEllipseOfACircleHoldsNinetyFivePercent) {
  const Json ellipse = ellipse95(4.0, 0.0, 4.0);
  EXPECT_NEAR(ellipse.at("semi_major_m"), 2.0 * 2.4477, 1e-3);
  EXPECT_NEAR(ellipse.at("semi_minor_m"), 2.0 * 2.4477, 1e-3);
}

TEST(MapGeometry, TheMajorAxisIsClockwiseFromNorth) {
  EXPECT_NEAR(ellipse95(9.0, 0.0, 1.0).at("azimuth_deg"), 90.0, 1e-9);
  EXPECT_NEAR(ellipse95(1.0, 0.0, 9.0).at("azimuth_deg"), 0.0, 1e-9);
  EXPECT_NEAR(ellipse95(5.0, 4.0, 5.0).at("azimuth_deg"), 45.0, 1e-9);
  EXPECT_NEAR(ellipse95(5.0, 4.0, 5.0).at("semi_major_m"), 3.0 * 2.4477, 1e-3);
  EXPECT_NEAR(ellipse95(5.0, 4.0, 5.0).at("semi_minor_m"), 1.0 * 2.4477, 1e-3);
}

TEST(MapGeometry, WhatIsNoCovarianceHasNoEllipse) {
  EXPECT_TRUE(ellipse95(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0).is_null());
  EXPECT_TRUE(ellipse95(1.0, 2.0, 1.0).is_null());
}

TEST(MapGeometry, MeasuresAlongTheEllipsoid) {
  const auto line = measure("?from=0,0&to=0,1");
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->at("distance_m"), 111319.49, 0.01);
  EXPECT_NEAR(line->at("azimuth_deg"), 90.0, 1e-9);
  EXPECT_EQ(line->at("mgrs"), "31NBA7740400000") << "of where it ends";
  for (const char* wrong : {"", "?from=1,2", "?from=1,2&to=3", "?from=91,0&to=0,0",
                            "?from=a,b&to=1,2", "?from=nan,0&to=0,0"}) {
    EXPECT_FALSE(measure(wrong)) << wrong;
  }
}

TEST(MapGeometry, TheGridOfASmallBoxHasSomeLinesOfARoundStep) {
  const auto grid = utm_grid("?box=16.59,49.22,16.61,49.235");
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->at("zone"), 33);
  const double step_m = grid->at("step_m");
  EXPECT_GE(grid->at("lines").size(), 6U);
  EXPECT_LE(grid->at("lines").size(), 30U);
  for (const Json& line : grid->at("lines")) {
    const double at_m = line.at("at_m");
    EXPECT_DOUBLE_EQ(std::remainder(at_m, step_m), 0.0);
  }
}

TEST(MapGeometry, TheGridNamesTheSquaresInView) {
  const auto names = [](const char* box) {
    std::vector<std::string> all;
    const auto grid = utm_grid(box);
    for (const Json& square : grid->at("squares")) all.push_back(square.at("name"));
    return all;
  };
  EXPECT_EQ(names("?box=16.59,49.22,16.61,49.235"), std::vector<std::string>{"33UXQ"});
  // Brno lies near the corner of four.
  EXPECT_EQ(names("?box=16.2,48.5,16.6,48.9"),
            (std::vector<std::string>{"33UWP", "33UWQ", "33UXP", "33UXQ"}));
}

TEST(MapGeometry, NoGridOfWhatIsNoBoxOrTooLarge) {
  for (const char* wrong : {"", "?box=1,2,3", "?box=2,2,1,3", "?box=0,0,60,60", "?box=0,85,1,86"}) {
    EXPECT_FALSE(utm_grid(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace ols::console
