#include "calibration/trajectory.h"

#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

// At 10 m/s, with a pause.
Trajectory paused_flight() {
  Trajectory trajectory;
  for (const std::int64_t s : {0, 1, 2, 6}) {
    trajectory.points.push_back({1'000'000 * s, {10.0 * static_cast<double>(s), 0.0, 0.0}});
  }
  return trajectory;
}

TEST(MotionAt, IsOnTheChordAroundTheInstant) {
  const Motion motion = motion_at(paused_flight(), 1.25e6);
  EXPECT_NEAR(motion.ecef.x(), 12.5, 1e-9);
  EXPECT_NEAR(motion.velocity_ecef.x(), 10.0, 1e-9);
  EXPECT_EQ(motion.gap_s, 1.0);
  EXPECT_EQ(motion_at(paused_flight(), 4e6).gap_s, 4.0);
}

TEST(MotionAt, APositionItselfIsKnownWhateverComesAfter) {
  EXPECT_EQ(motion_at(paused_flight(), 2e6).gap_s, 0.0);
  EXPECT_EQ(motion_at(paused_flight(), 6e6).gap_s, 0.0);
}

TEST(MotionAt, BeyondTheEndsItGoesOn) {
  EXPECT_NEAR(motion_at(paused_flight(), -1e6).ecef.x(), -10.0, 1e-9);
  EXPECT_NEAR(motion_at(paused_flight(), 7e6).ecef.x(), 70.0, 1e-9);
}

}  // namespace
}  // namespace ols::calibration
