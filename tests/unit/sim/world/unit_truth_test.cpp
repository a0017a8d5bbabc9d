#include "sim/world/unit_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"
#include "sim/world/world.h"

namespace ols::sim {
namespace {

constexpr double kArcsec = kPi / 648000.0;
constexpr double kCount = 11.5714 * kArcsec;
constexpr double kTwoPiOver112000 = 2.0 * kPi / 112000.0;

UnitTruth drawn(UnitErrors size, std::uint64_t seed) {
  ChainParameters chain;
  CameraIntrinsics camera;
  return draw_unit(UnitErrorsScenario{.size = size}, seed, chain, camera);
}

// Two programs that share no line agree on what eq. (1) is.
TEST(UnitTruth, WithoutErrorsTheCameraIsWhereTheChainHasIt) {
  ChainParameters chain;
  chain.heading_rad = 1.1, chain.tilt_x_rad = 0.02, chain.tilt_y_rad = -0.03;
  chain.mount_z_rad = 0.01, chain.mount_x_rad = -0.02, chain.mount_y_rad = 0.03;
  chain.azi_to_ele_m = {0.01, 0.02, 0.03};
  chain.trunnion_rad = 0.004;
  const PanTilt angles{0.7, 0.3};
  const Eigen::Isometry3d product = enu_from_camera(chain, angles);
  const Eigen::Isometry3d own = camera_on(chain, chain.trunnion_rad, angles);
  EXPECT_LT((product.matrix() - own.matrix()).norm(), 1e-12);
}

TEST(UnitTruth, NoneIsExactAndDrawsNothing) {
  ChainParameters chain;
  CameraIntrinsics camera;
  const UnitTruth unit = draw_unit({}, 7, chain, camera);
  EXPECT_TRUE(unit.exact);
  EXPECT_EQ(chain.mount_z_rad, 0.0);
  EXPECT_EQ(camera.fx_px, CameraIntrinsics{}.fx_px);
  const UnitMechanics mechanics(unit, kCount);
  EXPECT_EQ(mechanics.shafts({1.0, 0.2}).pan_rad, 1.0);
}

TEST(UnitTruth, SizesAreTheStatedOnes) {
  constexpr int kUnits = 2000;
  const auto spread = [](UnitErrors size, auto of) {
    double squares = 0.0;
    for (std::uint64_t seed = 1; seed <= kUnits; ++seed)
      squares += std::pow(of(drawn(size, seed)), 2);
    return std::sqrt(squares / kUnits) / kArcsec;
  };
  const auto cos1 = [](const UnitTruth& unit) { return unit.pan.cos1_rad; };
  const auto trunnion = [](const UnitTruth& unit) { return unit.trunnion_rad; };
  EXPECT_NEAR(spread(UnitErrors::kNew, cos1), 40.0, 2.0);
  EXPECT_NEAR(spread(UnitErrors::kWorkshop, cos1), 5.0, 0.3);
  EXPECT_NEAR(spread(UnitErrors::kNew, trunnion), 60.0, 3.0);
  EXPECT_NEAR(spread(UnitErrors::kWorkshop, trunnion), 4.0, 0.3);
}

// A motor that turns back takes its shaft with it only after the slack.
TEST(UnitTruth, TheSlackIsFollowed) {
  UnitTruth unit;
  unit.exact = false;
  unit.pan.slack_rad = 20.0 * kArcsec;
  UnitMechanics mechanics(unit, kCount);
  const auto behind = [&](double pan_rad) {
    mechanics.follow({pan_rad, 0.0});
    const double exact = pan_rad / kCount * kTwoPiOver112000;
    return (mechanics.shafts({pan_rad, 0.0}).pan_rad - exact) / kArcsec;
  };
  behind(0.0);
  EXPECT_NEAR(behind(0.1), -10.0, 1e-6) << "upwards: it lags";
  EXPECT_NEAR(behind(0.1 - 5.0 * kArcsec), -5.0, 1e-6) << "within the slack it stands";
  EXPECT_NEAR(behind(0.05), 10.0, 1e-6);
  EXPECT_NEAR((mechanics.shafts_from({0.05, 0.0}, 1, 1).pan_rad -
               mechanics.shafts_from({0.05, 0.0}, -1, 1).pan_rad) /
                  kArcsec,
              -20.0, 1e-6);
}

TEST(UnitTruth, JitterBelongsToACount) {
  UnitTruth unit;
  unit.exact = false;
  unit.jitter_rad = 5.0 * kArcsec;
  unit.jitter_seed = 3;
  const UnitMechanics mechanics(unit, kCount);
  double squares = 0.0;
  for (int count = 0; count < 4000; ++count) {
    const PanTilt at{count * kCount, 0.0};
    EXPECT_EQ(mechanics.shafts(at).pan_rad, mechanics.shafts(at).pan_rad);
    squares += std::pow(mechanics.shafts(at).pan_rad - count * kTwoPiOver112000, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 4000) / kArcsec, 5.0, 0.3);
}

TEST(UnitTruth, AnHonestConfigurationStatesTheMounting) {
  const UnitErrorsScenario plain;
  EXPECT_EQ(stated_mount(plain, {}).across_rad, 0.0);
  const MountSize size = stated_mount(UnitErrorsScenario{.size = UnitErrors::kNew}, {});
  EXPECT_GT(size.across_rad / kArcsec, 360.0);
  EXPECT_NEAR(size.roll_rad / kArcsec, 720.0, 1e-6);
}

}  // namespace
}  // namespace ols::sim
