#include "sim/ptu/external_mount.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

TEST(ExternalMount, AnglesLieOnALineBetweenTwoStatements) {
  ExternalMount mount;
  EXPECT_EQ(mount.angles_at(5.0).pan_rad, 0.0);
  mount.state(10.0, {0.1, -0.2});
  mount.state(10.2, {0.3, -0.1});
  EXPECT_NEAR(mount.angles_at(10.05).pan_rad, 0.15, 1e-12);
  EXPECT_NEAR(mount.angles_at(10.05).tilt_rad, -0.175, 1e-12);
  EXPECT_EQ(mount.angles_at(11.0).pan_rad, 0.3);
}

TEST(ExternalMount, AnOlderStatementIsIgnored) {
  ExternalMount mount;
  mount.state(10.0, {0.1, 0.0});
  mount.state(9.0, {0.9, 0.0});
  EXPECT_EQ(mount.angles_at(9.0).pan_rad, 0.1);
  EXPECT_EQ(mount.angles_at(10.0).pan_rad, 0.1);
}

TEST(ExternalMount, TwoSecondsAreKept) {
  ExternalMount mount;
  for (int i = 0; i <= 1000; ++i) mount.state(0.01 * i, {0.01 * i, 0.0});
  EXPECT_NEAR(mount.angles_at(8.005).pan_rad, 8.005, 1e-9);
  EXPECT_GT(mount.angles_at(0.0).pan_rad, 1.0);  // and not much more
}

}  // namespace
}  // namespace ols::sim
