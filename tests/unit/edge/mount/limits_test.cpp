#include "edge/mount/limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

struct ReachCase {
  double now_deg, pan_deg, tilt_deg;
  Reach reach;
  double chosen_deg;
};

TEST(Reach, DirectLongWayRoundOrNotAtAll) {
  const Limits d46{radians(-159.0), radians(159.0), radians(-47.0), radians(31.0)};
  const Limits wide{radians(-300.0), radians(300.0), radians(-47.0), radians(31.0)};
  for (const ReachCase& c :
       {ReachCase{0, 100, 10, Reach::kDirect, 100}, ReachCase{0, 460, 10, Reach::kDirect, 100},
        ReachCase{150, -150, 0, Reach::kLongWayRound, -150},
        ReachCase{-150, 150, 0, Reach::kLongWayRound, 150},
        ReachCase{0, 170, 0, Reach::kUnreachable, 170},
        ReachCase{0, 0, 31.1, Reach::kUnreachable, 0},
        ReachCase{0, 0, -47.1, Reach::kUnreachable, 0}}) {
    PanTilt angles{radians(c.pan_deg), radians(c.tilt_deg)};
    EXPECT_EQ(reach(d46, {radians(c.now_deg), 0.0}, angles), c.reach) << c.now_deg << c.pan_deg;
    EXPECT_NEAR(degrees(angles.pan_rad), c.chosen_deg, 1e-9);
  }
  PanTilt angles{radians(-170.0), 0.0};
  EXPECT_EQ(reach(wide, {radians(150.0), 0.0}, angles), Reach::kDirect);
  EXPECT_NEAR(degrees(angles.pan_rad), 190.0, 1e-9);
  angles = {radians(40.0), 0.0};
  EXPECT_EQ(reach(wide, {radians(290.0), 0.0}, angles), Reach::kLongWayRound);
  EXPECT_NEAR(degrees(angles.pan_rad), 40.0, 1e-9);
  angles = {std::nan(""), 0.0};
  EXPECT_EQ(reach(wide, {}, angles), Reach::kUnreachable);
}

}  // namespace
}  // namespace ols::mount
