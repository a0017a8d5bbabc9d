#include "edge/mount/keep_out.h"

#include <gtest/gtest.h>

#include <random>

#include "edge/ptu/servo.h"
#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols::ptu {
namespace {

PanTilt deg(double pan, double tilt) { return {radians(pan), radians(tilt)}; }

mount::KeepOut region(double pan_min, double pan_max, double tilt_min, double tilt_max) {
  return {radians(pan_min), radians(pan_max), radians(tilt_min), radians(tilt_max)};
}

const mount::AngleBox kTravel = region(-159, 159, -47, 31);
// A mast: from the bottom of the travel to 5 degrees above the horizon.
const mount::KeepOut kMast = region(20, 40, -47, 5);
// A wall: over the whole height.
const mount::KeepOut kWall = region(60, 70, -90, 90);

bool inside(const mount::KeepOut& r, const PanTilt& p) {
  return p.pan_rad > r.pan_min_rad && p.pan_rad < r.pan_max_rad && p.tilt_rad > r.tilt_min_rad &&
         p.tilt_rad < r.tilt_max_rad;
}

TEST(KeepOut, DirectWhenTheWholeBoxIsFree) {
  const auto way = way_round(kTravel, {kMast}, deg(0, 10), deg(80, 6));
  ASSERT_TRUE(way);
  EXPECT_EQ(way->size(), 1u);
}

TEST(KeepOut, RoundTheMastOverItsTop) {
  const auto way = way_round(kTravel, {kMast}, deg(0, -10), deg(80, -20));
  ASSERT_TRUE(way);
  ASSERT_EQ(way->size(), 3u);  // up, across, down
  EXPECT_GT((*way)[0].tilt_rad, radians(5.2));
  EXPECT_LT((*way)[0].tilt_rad, radians(5.5));
  EXPECT_DOUBLE_EQ((*way)[2].pan_rad, radians(80.0));
}

TEST(KeepOut, RoundTheMastInBothDirections) {
  const auto way = way_round(kTravel, {kMast}, deg(80, -20), deg(0, -10));
  ASSERT_TRUE(way);
  ASSERT_EQ(way->size(), 3u);
  EXPECT_GT((*way)[1].tilt_rad, radians(5.2));
  EXPECT_DOUBLE_EQ((*way)[2].pan_rad, 0.0);
}

TEST(KeepOut, NoWayThroughAWallOrIntoARegion) {
  EXPECT_FALSE(way_round(kTravel, {kWall}, deg(0, 0), deg(80, 0)));
  EXPECT_FALSE(way_round(kTravel, {kMast}, deg(0, 0), deg(30, 0)));
  EXPECT_FALSE(way_round(kTravel, {kMast}, deg(0, 0), deg(30, 5.1)));  // its clearance
  EXPECT_FALSE(way_round(kTravel, {kMast}, deg(0, 0), deg(170, 0)));
}

TEST(KeepOut, OutOfARegionByTheShortestWay) {
  const auto way = way_round(kTravel, {kMast}, deg(22, -20), deg(80, 20));
  ASSERT_TRUE(way);
  EXPECT_NEAR(degrees(way->front().pan_rad), 19.73, 0.05);
  EXPECT_DOUBLE_EQ(way->front().tilt_rad, radians(-20.0));
}

// Whatever the regions: a way that is given is free, leg by leg, and ends where it shall.
TEST(KeepOut, WaysAreFree) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> pan(-150, 150), tilt(-45, 30), size(2, 60);
  int found = 0, detours = 0;
  for (int run = 0; run < 2000; ++run) {
    std::vector<mount::KeepOut> regions;
    for (int i = 0; i < 5; ++i) {
      const double p = pan(random), t = tilt(random);
      regions.push_back(region(p, p + size(random), t, t + 0.5 * size(random)));
    }
    const PanTilt from = deg(pan(random), tilt(random)), to = deg(pan(random), tilt(random));
    if (blocked(regions, from)) continue;
    const auto way = way_round(kTravel, regions, from, to);
    if (!way) continue;
    ++found;
    detours += way->size() > 1 ? 1 : 0;
    PanTilt at = from;
    for (const PanTilt& next : *way) {
      ASSERT_FALSE(blocked(regions, mount::spanned(at, next)));
      at = next;
    }
    ASSERT_EQ(at.pan_rad, to.pan_rad);
    ASSERT_EQ(at.tilt_rad, to.tilt_rad);
  }
  EXPECT_GT(found, 400);
  EXPECT_GT(detours, 100);
}

TEST(KeepOut, ReachChoosesTheFreeTurn) {
  mount::Limits limits{radians(-300), radians(300), radians(-47), radians(31)};
  limits.keep_out = {kWall};
  PanTilt angles = deg(100, 0);
  EXPECT_EQ(reach(limits, deg(0, 0), angles), mount::Reach::kLongWayRound);
  EXPECT_NEAR(degrees(angles.pan_rad), -260.0, 1e-9);
  angles = deg(65, 0);
  EXPECT_EQ(reach(limits, deg(0, 0), angles), mount::Reach::kLongWayRound);  // -295
  limits.pan_min_rad = radians(-159);
  angles = deg(65, 0);
  EXPECT_EQ(reach(limits, deg(0, 0), angles), mount::Reach::kUnreachable);
  angles = deg(100, 0);
  EXPECT_EQ(reach(limits, deg(0, 0), angles), mount::Reach::kUnreachable);
  limits.keep_out = {kMast};
  angles = deg(80, -10);
  EXPECT_EQ(reach(limits, deg(0, -10), angles), mount::Reach::kLongWayRound);
  angles = deg(10, -10);
  EXPECT_EQ(reach(limits, deg(0, -10), angles), mount::Reach::kDirect);
}

class KeepOutInMotion : public testing::Test {
 protected:
  static PtuConfig config() {
    PtuConfig ptu = quick_driver();
    ptu.acceleration_rad_s2 = radians(60.0);
    ptu.limits.keep_out = {kMast, region(-60, -30, -10, 10)};
    return ptu;
  }
  void watch() {
    for (const mount::KeepOut& r : config().limits.keep_out) {
      ASSERT_FALSE(inside(r, loop.truth()))
          << degrees(loop.truth().pan_rad) << ' ' << degrees(loop.truth().tilt_rad);
    }
  }
  ClosedLoop loop{config(), quick_unit()};
};

TEST_F(KeepOutInMotion, GoesRoundTheMast) {
  ASSERT_TRUE(loop.start());
  double highest_rad = -1.0;
  loop.run(12.0, [&] {
    loop.driver.set_goal(loop.goal(deg(80, -20)));
    highest_rad = std::max(highest_rad, loop.truth().tilt_rad);
    watch();
  });
  EXPECT_NEAR(degrees(loop.truth().pan_rad), 80.0, 0.01);
  EXPECT_NEAR(degrees(loop.truth().tilt_rad), -20.0, 0.01);
  EXPECT_GT(degrees(highest_rad), 5.0);
}

// A target that goes behind the mast: to its border, no further, and round it when it comes out.
TEST_F(KeepOutInMotion, TrackingStopsAtTheBorder) {
  ASSERT_TRUE(loop.start());
  const double begin_s = loop.time_s;
  const auto follow = [&] {
    const double t = loop.time_s - begin_s;
    loop.driver.set_goal(loop.goal(deg(10.0 * t, 0.0), deg(10.0, 0.0)));
    watch();
  };
  loop.run(3.5, follow);
  EXPECT_GT(degrees(loop.truth().pan_rad), 19.5);
  EXPECT_LT(degrees(loop.truth().pan_rad), 20.0);
  loop.run(6.5, follow);
  EXPECT_NEAR(degrees(loop.truth().pan_rad), 100.0, 1.0);
  EXPECT_NEAR(degrees(loop.truth().tilt_rad), 0.0, 0.1);
}

// Also on the way to rest, where the unit comes to its corners as fast as it can brake.
TEST_F(KeepOutInMotion, IsNeverEnteredWhateverTheGoals) {
  ASSERT_TRUE(loop.start());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> pan(-110, 110), tilt(-40, 28), rate(-40, 40);
  std::uniform_real_distribution<double> stay_s(0.1, 3.0);
  mount::Goal goal = loop.goal({});
  double change_s = 0.0;
  loop.run(600.0, [&] {
    if (loop.time_s >= change_s) {
      goal = loop.goal(deg(pan(random), tilt(random)), deg(rate(random), 0.3 * rate(random)));
      goal.rests = random() % 2 == 0;
      if (goal.rests) goal.rate = {};
      change_s = loop.time_s + stay_s(random);
    }
    mount::Goal now = goal;
    const double dt_s = loop.time_s - goal.time_s;
    now.angles.pan_rad += dt_s * goal.rate.pan_rad;
    now.angles.tilt_rad += dt_s * goal.rate.tilt_rad;
    now.time_s = loop.time_s;
    now.valid_until_s = loop.time_s + 0.5;
    loop.driver.set_goal(now);
    watch();
  });
  EXPECT_EQ(loop.driver.counters().errors, 0u);
}

}  // namespace
}  // namespace ols::ptu
