#include "edge/calibration/view_tour.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::station {
namespace {

ViewTour::Config every_ten_minutes() {
  ViewTour::Config config;
  config.interval_s = 600.0;
  return config;
}

const double kCount = radians(11.5714 / 3600.0);

mount::Limits travel() { return {-radians(159), radians(159), -radians(46), radians(31)}; }

// A unit that goes where it is told, at 40 degrees a second, and a camera of 10 Hz.
class ViewTourTest : public testing::Test {
 protected:
  ViewTourTest() { tour.plan(travel(), {kCount, kCount}); }
  void run(double seconds) {
    for (const double end_s = now_s + seconds; now_s < end_s; now_s += 0.1) {
      const auto goal = tour.step({now_s, free, at});
      commanded += goal.has_value();
      if (goal) {
        constexpr double kStep_rad = 0.07;
        at.pan_rad += std::clamp(goal->angles.pan_rad - at.pan_rad, -kStep_rad, kStep_rad);
        at.tilt_rad += std::clamp(goal->angles.tilt_rad - at.tilt_rad, -kStep_rad, kStep_rad);
        rising = goal->angles.pan_rad >= last.pan_rad;
        last = goal->angles;
      }
      if (const auto view = tour.see(now_s)) {
        seen.push_back(*view);
        EXPECT_NEAR(at.pan_rad, tour.views()[*view].pan_rad, 0.5 * kCount);
        EXPECT_TRUE(rising) << "from below, as always";
      }
    }
  }

  ViewTour tour{every_ten_minutes()};
  double now_s = 100.0;
  bool free = true, rising = false;
  PanTilt at, last;
  int commanded = 0;
  std::vector<std::size_t> seen;
};

TEST_F(ViewTourTest, FourViewsAQuarterTurnApart) {
  ASSERT_EQ(tour.views().size(), 4U);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(degrees(tour.views()[i].pan_rad - tour.views()[i - 1].pan_rad), 90.0, 0.01);
  }
  EXPECT_NEAR(std::remainder(tour.views()[0].pan_rad, kCount), 0.0, 1e-9) << "whole counts";
}

TEST_F(ViewTourTest, ComesAfterTenMinutesOfIdlenessAndAgain) {
  run(590.0);
  EXPECT_EQ(commanded, 0);
  run(120.0);
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(tour.take_finished());
  EXPECT_FALSE(tour.take_finished()) << "once";
  commanded = 0;
  run(400.0);
  EXPECT_EQ(commanded, 0);
  run(300.0);
  EXPECT_EQ(seen.size(), 8U);
}

TEST_F(ViewTourTest, ComesOnRequest) {
  tour.request();
  run(10.0);
  EXPECT_EQ(commanded, 0) << "it has just become free";
  run(110.0);
  EXPECT_EQ(seen.size(), 4U);
}

TEST_F(ViewTourTest, YieldsAtOnceAndStartsAnewLater) {
  tour.request();
  run(35.0);
  ASSERT_TRUE(tour.under_way());
  free = false;
  commanded = 0;
  run(0.1);
  EXPECT_FALSE(tour.under_way());
  run(5.0);
  EXPECT_EQ(commanded, 0);
  EXPECT_FALSE(tour.take_finished());
  free = true;
  seen.clear();
  run(120.0);
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST_F(ViewTourTest, AUnitThatDoesNotArriveEndsTheRound) {
  tour.request();
  double stuck_s = now_s;
  for (; stuck_s < 200.0; stuck_s += 0.1) tour.step({stuck_s, true, PanTilt{}});
  EXPECT_FALSE(tour.under_way());
  EXPECT_FALSE(tour.take_finished());
  EXPECT_EQ(tour.late(), 1);
  now_s = stuck_s;
  tour.request();
  run(120.0);
  EXPECT_TRUE(tour.take_finished());
  EXPECT_EQ(tour.late(), 0);
}

// The sun stands there, for some rounds.
TEST_F(ViewTourTest, WhereTheSunStandsItDoesNotLook) {
  PanTilt sun;
  ViewTour::Config config = every_ten_minutes();
  config.forbidden = [&sun](const PanTilt& view) {
    return std::abs(view.pan_rad - sun.pan_rad) < radians(8.0);
  };
  tour = ViewTour(config);
  tour.plan(travel(), {kCount, kCount});
  sun = tour.views()[1];
  tour.request();
  run(120.0);
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 2, 3}));
  EXPECT_TRUE(tour.take_finished());
  sun = tour.views()[3];
  seen.clear();
  tour.request();
  run(120.0);
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(tour.take_finished()) << "without its last view, too";
  EXPECT_EQ(tour.late(), 0);
}

// Long before the next round is due, and once.
TEST_F(ViewTourTest, WhatWasLeftOutIsSeenWhenTheSunHasGoneOn) {
  bool shines = true;
  ViewTour::Config config = every_ten_minutes();
  config.forbidden = [&](const PanTilt& view) {
    return shines && view.pan_rad == tour.views()[2].pan_rad;
  };
  tour = ViewTour(config);
  tour.plan(travel(), {kCount, kCount});
  tour.request();
  run(120.0);
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_EQ(tour.left_out(), (std::vector<std::size_t>{2}));
  shines = false;
  seen.clear();
  run(120.0);
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(tour.left_out().empty());
  run(200.0);
  EXPECT_EQ(seen.size(), 4U);
}

TEST_F(ViewTourTest, WhatIsForbiddenIsNoView) {
  mount::Limits limits = travel();
  limits.keep_out.push_back({radians(-50), radians(-40), radians(-10), radians(31)});
  tour.plan(limits, {kCount, kCount});
  EXPECT_EQ(tour.views().size(), 3U);
  limits.keep_out.push_back({radians(40), radians(50), radians(-10), radians(31)});
  tour.plan(limits, {kCount, kCount});
  tour.request();
  run(120.0);
  EXPECT_EQ(commanded, 0) << "two views tell nothing";
}

}  // namespace
}  // namespace ols::station
