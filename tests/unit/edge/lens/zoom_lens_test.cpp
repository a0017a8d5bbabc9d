#include "edge/lens/zoom_lens.h"

#include <gtest/gtest.h>

namespace ols::lens {
namespace {

ZoomTable table() {
  std::vector<ZoomPoint> points(2);
  points[0].camera.fx_px = points[0].camera.fy_px = 1000.0;
  points[1].position = 1.0;
  points[1].camera.fx_px = points[1].camera.fy_px = 10000.0;
  return ZoomTable(points);
}

TEST(ZoomLens, KnowsNothingBeforeTheLensHasSpokenAndSoonAfterItFellSilent) {
  ZoomLens lens(table(), 0.001);
  EXPECT_FALSE(lens.at(10.0));
  EXPECT_FALSE(lens.newest());
  lens.add({10.0, 0.01, 0.5});
  ASSERT_TRUE(lens.at(10.9));
  EXPECT_NEAR(lens.at(10.9)->position, 0.5, 1e-12);
  EXPECT_FALSE(lens.at(11.1));
  EXPECT_FALSE(lens.at(8.9));
}

TEST(ZoomLens, InterpolatesAndStatesMoreWhileItMoves) {
  ZoomLens lens(table(), 0.001);
  lens.add({10.0, 0.01, 0.2});
  lens.add({10.1, 0.01, 0.2});
  const double still = lens.at(10.1)->focal_sd_px / lens.at(10.1)->camera.fx_px;
  lens.add({10.2, 0.01, 0.3});
  EXPECT_NEAR(lens.at(10.15)->position, 0.25, 1e-12);
  const double moving = lens.at(10.15)->focal_sd_px / lens.at(10.15)->camera.fx_px;
  EXPECT_GT(moving, 5.0 * still);
  const double later = lens.at(10.4)->focal_sd_px / lens.at(10.4)->camera.fx_px;
  EXPECT_GT(later, 5.0 * moving) << "where it is by now is a guess";
}

TEST(ZoomLens, RestsWhileItsReportsAreTheSame) {
  ZoomLens lens(table(), 0.001);
  lens.add({10.0, 0.01, 0.2});
  EXPECT_FALSE(lens.rests_at(10.0)) << "nothing is known of the time before";
  lens.add({10.1, 0.01, 0.2005});
  lens.add({10.2, 0.01, 0.21});
  EXPECT_EQ(lens.rests_at(10.05), true);
  EXPECT_EQ(lens.rests_at(10.15), false);
  EXPECT_FALSE(lens.rests_at(10.25)) << "nor of the time after";
  lens.add({11.5, 0.01, 0.21});
  EXPECT_FALSE(lens.rests_at(10.8)) << "it may have moved there and back";
}

TEST(ZoomLens, SamplesOutOfOrderAreDropped) {
  ZoomLens lens(table(), 0.001);
  lens.add({10.0, 0.01, 0.2});
  lens.add({9.9, 0.01, 0.9});
  EXPECT_NEAR(lens.newest()->position, 0.2, 1e-12);
}

}  // namespace
}  // namespace ols::lens
