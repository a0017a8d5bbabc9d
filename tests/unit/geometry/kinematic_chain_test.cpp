#include "geometry/kinematic_chain.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using Eigen::Vector3d;
using test::near;

// Without lever arms but for the tripod's height.
ChainParameters facing_east() {
  ChainParameters chain;
  chain.heading_rad = radians(90.0);
  return chain;
}

Vector3d looks_along(const ChainParameters& chain, const PanTilt& angles) {
  return enu_from_camera(chain, angles).linear().col(2);
}

PanTilt at_deg(double pan_deg, double tilt_deg) { return {radians(pan_deg), radians(tilt_deg)}; }

TEST(KinematicChain, NextJointIsEquationOne) {
  const Link link{{1.0, 2.0, 3.0}, radians(90.0), radians(90.0), radians(90.0)};
  // RY: X -> -Z. RX: -Z -> Y. RZ: Y -> -X.
  const Eigen::Isometry3d M = next_joint(Eigen::Isometry3d::Identity(), link);
  EXPECT_TRUE(near(M.linear().col(0), Vector3d(-1, 0, 0), 1e-15));
  // RY leaves Y, RX: Y -> Z, RZ leaves Z.
  EXPECT_TRUE(near(M.linear().col(1), Vector3d(0, 0, 1), 1e-15));
  EXPECT_TRUE(near(M.translation(), Vector3d(1, 2, 3), 1e-15));
  // The second translation is in the first joint's frame.
  const Eigen::Isometry3d second = next_joint(M, Link{{10.0, 0.0, 0.0}});
  EXPECT_TRUE(near(second.translation(), Vector3d(-9, 2, 3), 1e-14));
}

TEST(KinematicChain, HeadingEastLooksEast) {
  EXPECT_TRUE(near(looks_along(facing_east(), {}), Vector3d(1, 0, 0), 1e-15));
}

TEST(KinematicChain, CameraIsUprightAtRest) {
  const Eigen::Matrix3d R = enu_from_camera(facing_east(), {}).linear();
  EXPECT_TRUE(near(R.col(0), Vector3d(0, -1, 0), 1e-15));  // right is south
  EXPECT_TRUE(near(R.col(1), Vector3d(0, 0, -1), 1e-15));  // down
}

TEST(KinematicChain, PositivePanTurnsLeftAndPositiveTiltLooksUp) {
  EXPECT_TRUE(near(looks_along(facing_east(), at_deg(90, 0)), Vector3d(0, 1, 0), 1e-15));
  const double c = std::cos(radians(30.0));
  EXPECT_TRUE(near(looks_along(facing_east(), at_deg(0, 30)), Vector3d(c, 0, 0.5), 1e-15));
  EXPECT_TRUE(near(looks_along(facing_east(), at_deg(90, 30)), Vector3d(0, c, 0.5), 1e-15));
}

TEST(KinematicChain, EncoderSignsAndZeros) {
  ChainParameters chain = facing_east();
  chain.pan_sign = -1;
  chain.tilt_sign = -1;
  chain.pan_zero_rad = radians(10.0);
  chain.tilt_zero_rad = radians(5.0);
  // Shaft pan 10 - 40 = -30 (right, to the south), shaft tilt 5 + 15 = 20 (up).
  const auto d = azimuth_elevation_from_enu(looks_along(chain, at_deg(40, -15)));
  EXPECT_NEAR(degrees(d.azimuth_rad), 120.0, 1e-12);
  EXPECT_NEAR(degrees(d.elevation_rad), 20.0, 1e-12);
}

TEST(KinematicChain, TiltXPutsTheRightSideDown) {
  ChainParameters chain = facing_east();
  chain.tilt_x_rad = radians(10.0);
  EXPECT_TRUE(near(looks_along(chain, {}), Vector3d(1, 0, 0), 1e-15));
  // To the right (south) it now looks down by as much, to the left up.
  EXPECT_NEAR(looks_along(chain, at_deg(-90, 0)).z(), -std::sin(radians(10.0)), 1e-15);
  EXPECT_NEAR(looks_along(chain, at_deg(90, 0)).z(), std::sin(radians(10.0)), 1e-15);
}

TEST(KinematicChain, TiltYPutsTheNoseDown) {
  ChainParameters chain = facing_east();
  chain.tilt_y_rad = radians(10.0);
  EXPECT_NEAR(looks_along(chain, {}).z(), -std::sin(radians(10.0)), 1e-15);
  EXPECT_NEAR(looks_along(chain, at_deg(180, 0)).z(), std::sin(radians(10.0)), 1e-15);
}

TEST(KinematicChain, MountingRotations) {
  ChainParameters chain = facing_east();
  chain.mount_z_rad = radians(2.0);  // left
  EXPECT_NEAR(azimuth_elevation_from_enu(looks_along(chain, {})).azimuth_rad, radians(88.0), 1e-14);
  chain = facing_east();
  chain.mount_y_rad = radians(2.0);  // nose down
  EXPECT_NEAR(looks_along(chain, {}).z(), -std::sin(radians(2.0)), 1e-15);
  chain = facing_east();
  chain.mount_x_rad = radians(2.0);  // clockwise from behind: the right edge of the image goes down
  EXPECT_NEAR(enu_from_camera(chain, {}).linear()(2, 0), -std::sin(radians(2.0)), 1e-15);
}

TEST(KinematicChain, JointsStandWhereTheLinksPutThem) {
  ChainParameters chain = facing_east();
  chain.ground_to_origin_m = {1.0, 2.0, 1.5};
  chain.origin_to_azi_m = {0.01, 0.0, 0.1};
  chain.ele_to_focus_m = {0.0, 0.0, 0.06};
  chain.focus_to_camera_m = {0.05, 0.0, 0.0};
  // Panned left to the north, then tilted straight up: what was up is now south.
  const auto poses = joints(chain, at_deg(90, 90));
  const auto position = [&](Joint joint) {
    return poses[static_cast<std::size_t>(joint)].translation().eval();
  };
  EXPECT_TRUE(near(position(Joint::kGround), Vector3d(0, 0, 0), 0.0));
  EXPECT_TRUE(near(position(Joint::kOrigin), Vector3d(1, 2, 1.5), 1e-15));
  EXPECT_TRUE(near(position(Joint::kAzi), Vector3d(1.01, 2, 1.6), 1e-15));
  EXPECT_TRUE(near(position(Joint::kEle), position(Joint::kAzi), 1e-15));
  EXPECT_TRUE(near(position(Joint::kFocus), Vector3d(1.01, 1.94, 1.6), 1e-15));
  EXPECT_TRUE(near(position(Joint::kCamera), Vector3d(1.01, 1.94, 1.65), 1e-15));
  EXPECT_TRUE(
      near(enu_from_camera(chain, at_deg(90, 90)).translation(), position(Joint::kCamera), 1e-15));
}

TEST(Aim, InvertsByHand) {
  const auto angles = aim(facing_east(), {0.0, 1.0, 1.0});
  ASSERT_TRUE(angles);
  EXPECT_NEAR(degrees(angles->pan_rad), 90.0, 1e-12);
  EXPECT_NEAR(degrees(angles->tilt_rad), 45.0, 1e-12);
}

class RandomChains : public testing::Test {
 protected:
  double uniform(double half_range) {
    return std::uniform_real_distribution<double>(-half_range, half_range)(random_);
  }

  Vector3d unit() {
    Vector3d v;
    do v = {uniform(1.0), uniform(1.0), uniform(1.0)};
    while (v.norm() < 0.1 || v.norm() > 1.0);
    return v.normalized();
  }

  ChainParameters chain() {
    ChainParameters c;
    c.heading_rad = uniform(kPi);
    c.tilt_x_rad = uniform(0.2);
    c.tilt_y_rad = uniform(0.2);
    c.mount_z_rad = uniform(0.2);
    c.mount_x_rad = uniform(0.2);
    c.mount_y_rad = uniform(0.2);
    c.pan_sign = uniform(1.0) > 0.0 ? 1 : -1;
    c.tilt_sign = uniform(1.0) > 0.0 ? 1 : -1;
    c.pan_zero_rad = uniform(1.0);
    c.tilt_zero_rad = uniform(0.3);
    return c;
  }

  std::mt19937 random_{20};
};

TEST_F(RandomChains, AimBringsTheRayOntoTheDirection) {
  int reached = 0;
  for (int i = 0; i < 2000; ++i) {
    const ChainParameters c = chain();
    const Vector3d direction_enu = unit();
    const Vector3d direction_cam = Vector3d(uniform(0.3), uniform(0.3), 1.0).normalized();
    const auto angles = aim(c, direction_enu, direction_cam);
    if (!angles) continue;
    ++reached;
    const Eigen::Matrix3d R = enu_from_camera(c, *angles).linear();
    EXPECT_TRUE(near(R * direction_cam, direction_enu, 1e-12));
    EXPECT_LE(std::abs(angles->pan_rad), kPi);
    EXPECT_LE(std::abs(c.tilt_sign * angles->tilt_rad + c.tilt_zero_rad), kPi / 2.0 + 1e-9);
  }
  EXPECT_GT(reached, 1800);
}

TEST_F(RandomChains, AimFindsTheAnglesItCameFrom) {
  for (int i = 0; i < 2000; ++i) {
    const ChainParameters c = chain();
    const double shaft_tilt_rad = uniform(radians(60.0));
    const PanTilt angles{uniform(kPi), c.tilt_sign * (shaft_tilt_rad - c.tilt_zero_rad)};
    const auto found = aim(c, looks_along(c, angles));
    ASSERT_TRUE(found);
    EXPECT_NEAR(wrap_pi(found->pan_rad - angles.pan_rad), 0.0, 1e-12);
    EXPECT_NEAR(found->tilt_rad, angles.tilt_rad, 1e-12);
  }
}

TEST(Aim, StraightUp) {
  const auto angles = aim(facing_east(), Vector3d::UnitZ());
  ASSERT_TRUE(angles);
  EXPECT_NEAR(angles->tilt_rad, kPi / 2.0, 1e-12);
  EXPECT_TRUE(near(looks_along(facing_east(), *angles), Vector3d::UnitZ(), 1e-12));
}

TEST(Aim, IsExactCloseToTheZenith) {
  const Vector3d direction(3e-7, -4e-7, 1.0);
  const auto angles = aim(facing_east(), direction);
  ASSERT_TRUE(angles);
  EXPECT_LT(angle_between(looks_along(facing_east(), *angles), direction), 1e-14);
}

TEST(Aim, NothingAroundThePanAxis) {
  // A ray 5 degrees to the side can never be turned to within 5 degrees of the pan axis.
  const Vector3d aside(std::sin(radians(5.0)), 0.0, std::cos(radians(5.0)));
  const auto up = [](double off_deg) {
    return Vector3d(std::sin(radians(off_deg)), 0.0, std::cos(radians(off_deg)));
  };
  EXPECT_FALSE(aim(facing_east(), Vector3d::UnitZ(), aside));
  EXPECT_FALSE(aim(facing_east(), up(4.9), aside));
  EXPECT_TRUE(aim(facing_east(), up(5.1), aside));
}

TEST(Aim, NothingThatNeedsTheCameraUpsideDown) {
  // A ray 10 degrees below the axis reaches 80 degrees of elevation, not 85.
  const Vector3d below(0.0, std::sin(radians(10.0)), std::cos(radians(10.0)));
  const auto at_elevation = [](double deg) {
    return enu_from_azimuth_elevation({radians(90.0), radians(deg)});
  };
  EXPECT_TRUE(aim(facing_east(), at_elevation(79.9), below));
  EXPECT_FALSE(aim(facing_east(), at_elevation(85.0), below));
}

TEST(Aim, NothingForNoDirection) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(aim(facing_east(), Vector3d::Zero()));
  EXPECT_FALSE(aim(facing_east(), Vector3d(nan, 0.0, 0.0)));
  EXPECT_FALSE(aim(facing_east(), Vector3d::UnitX(), Vector3d::Zero()));
}

}  // namespace
}  // namespace ols
