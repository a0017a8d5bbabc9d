#include "central/tracking/existence.h"

#include <gtest/gtest.h>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

constexpr std::int64_t kNow = 1'700'000'000'000'000;

TEST(Existence, IsCertainWithoutTrackletsAndOpenAtTheBeginning) {
  Existence existence;
  EXPECT_EQ(existence.probability(), 1.0);
  existence.begin();
  EXPECT_EQ(existence.probability(), 0.5);
}

// In three of four images, as a hidden station or misses leave it; in two, as a ghost has it.
TEST(Existence, GrowsWithThreeOfFourStationsAndFallsWithTwo) {
  Existence real, ghost;
  real.begin();
  ghost.begin();
  for (int i = 0; i < 40; ++i) {
    i % 4 == 0 ? real.missed() : real.seen();
    i % 4 < 2 ? ghost.missed() : ghost.seen();
  }
  EXPECT_GT(real.probability(), 0.95);
  EXPECT_LT(ghost.probability(), 0.05);
}

TEST(Existence, LearnsNothingFromAMissWhereItIsHidden) {
  Existence hidden, half, seen;
  for (Existence* existence : {&hidden, &half, &seen}) existence->begin();
  hidden.missed(0.0);
  half.missed(0.5);
  seen.missed();
  EXPECT_EQ(hidden.probability(), 0.5);
  EXPECT_NEAR(half.probability(), 0.6 / 1.4, 1e-9);
  EXPECT_NEAR(seen.probability(), 0.25, 1e-9);
}

TEST(Existence, ChangesItsMindWithinSomeImages) {
  Existence existence;
  existence.begin();
  for (int i = 0; i < 10'000; ++i) existence.seen();
  for (int i = 0; i < 10; ++i) existence.missed();
  EXPECT_LT(existence.probability(), 0.05);
}

BearingMeasurement image_of_a(std::int64_t utime_us) {
  return test::measurement_of(test::ray_to("a", {0, 0, 0}, {0, 300, 50}), utime_us);
}

TEST(StationViews, ShowWhatIsWellInsideOfACameraThatStandsStill) {
  const AzimuthElevation axis = image_of_a(kNow).sight.direction;
  StationViews views;
  const auto shows = [&](const Eigen::Vector3d& p_enu, std::int64_t utime_us = kNow) {
    return views.shows(image_of_a(utime_us), test::site().to_ecef(p_enu));
  };
  EXPECT_FALSE(shows({0, 300, 50})) << "no status yet";
  views.know("a", axis, 0.2, kNow - 500'000);
  EXPECT_FALSE(shows({0, 300, 50})) << "it may be turning";
  views.know("a", axis, 0.2, kNow);
  EXPECT_TRUE(shows({0, 300, 50}));
  EXPECT_TRUE(shows({25, 300, 50}));
  EXPECT_FALSE(shows({29, 300, 50})) << "at the border";
  EXPECT_FALSE(shows({0, -300, 50})) << "behind";
  EXPECT_FALSE(shows({0, 300, 50}, kNow + 3'000'000)) << "its status is old";
  views.know("a", {axis.azimuth_rad + 0.01, axis.elevation_rad}, 0.2, kNow + 1);
  EXPECT_FALSE(shows({0, 300, 50})) << "it has turned";
}

}  // namespace
}  // namespace ols::fusion
