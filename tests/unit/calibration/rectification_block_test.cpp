#include "calibration/rectification_block.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/adjustment.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using test::kArcsec;

Observation sighting(Kind kind, const std::string& name, const Vector2d& pixel) {
  Observation one;
  one.kind = kind;
  one.reading.pan = {1200.0, 0.0, 1};
  one.reading.tilt = {150.0, 0.0, -1};
  one.pixel = pixel;
  one.sd_px = 0.2;
  one.reference = name;
  return one;
}

Observation level_line(const Vector2d& left, const Vector2d& right) {
  Observation one = sighting(Kind::kLevelLine, "board", left);
  one.target.second_px = right;
  one.target.sd = 30.0 * kArcsec;
  return one;
}
Observation cross(const Vector2d& pixel) {
  Observation one = sighting(Kind::kCross, "cross", pixel);
  one.target = {Eigen::Vector2d::Zero(), 30.0, 0.4, 0.003};
  return one;
}
Observation ruler(const std::string& name, double away_m, const Vector2d& pixel) {
  Observation one = sighting(Kind::kRuler, name, pixel);
  one.target = {Eigen::Vector2d::Zero(), away_m, 0.13, 0.001};
  one.pose = 5;  // both in one picture
  return one;
}

struct Scene {
  Problem problem;
  Scene() {
    problem.names = {"alfa"};
    StationModel model = test::crooked();
    model.geometry.chain.trunnion_rad = 1e-4;
    model.geometry.chain.mount_x_rad = 2e-3;
    problem.stations = {test::prior_of(model)};
  }
  // Half of the misfit's slope is the gradient: by differences of each global. Left out are that
  // the camera's lever turns with its mounting, and that the tape's part of the variance depends on
  // the slope: some percent.
  void expect_derivatives() {
    const Network network = network_of(problem);
    ASSERT_EQ(network.groups.size(), 1U);
    const Adjustment adjustment(network);
    State state = adjustment.start({0.7});
    // Where the nuisance suits the state best, it has no part in the gradient.
    constexpr int kSteps = 20;
    for (int step = 0; step < kSteps; ++step) {
      state.nuisances[0] -= network.blocks[0]->equations(state, 0, 0.0).nuisance_step;
    }
    const BlockEquations here = network.blocks[0]->equations(state, 0, 0.0);
    ASSERT_TRUE(here.valid);
    for (std::size_t c = 0; c < here.columns.size(); ++c) {
      const double up = misfit_with(network, state, here.columns[c], 1.0);
      const double down = misfit_with(network, state, here.columns[c], -1.0);
      const double slope = (up - down) / (2.0 * step_of(here.columns[c]));
      const double expected = here.gradient[static_cast<Eigen::Index>(c)];
      EXPECT_NEAR(0.5 * slope, expected, 0.03 * std::abs(expected) + 2e-2)
          << "column " << here.columns[c];
    }
  }

 private:
  static double step_of(int column) {
    const bool is_pixel = column == kFocal || column == kCx || column == kCy;
    return is_pixel ? 1e-2 : column == kK2 ? 1e-4 : 1e-6;
  }
  double misfit_with(const Network& network, State state, int column, double sign) const {
    const double by = sign * step_of(column);
    if (column < kStationParameters) {
      StationVector change = state.stations[0].change;
      change[column] += by;
      state.stations[0] = station_at(problem.stations[0], change);
    } else {
      const int pose = column - network.layout.pose(0);
      state.poses[static_cast<std::size_t>(pose / 2)][pose % 2] += by;
    }
    return network.blocks[0]->equations(state, 0, 0.0).misfit;
  }
};

TEST(LevelLineBlock, ItsDerivativesAreThoseOfItsMisfit) {
  Scene scene;
  scene.problem.observations = {level_line({150.0, 200.0}, {1100.0, 204.0}),
                                level_line({150.0, 700.0}, {1100.0, 705.0})};
  scene.expect_derivatives();
}

TEST(CrossBlock, ItsDerivativesAreThoseOfItsMisfit) {
  Scene scene;
  scene.problem.observations = {cross({812.0, 430.0})};
  scene.expect_derivatives();
}

TEST(RulerBlock, ItsDerivativesAreThoseOfItsMisfit) {
  Scene scene;
  scene.problem.observations = {ruler("near", 20.0, {400.0, 479.5}),
                                ruler("far", 40.0, {900.0, 470.0})};
  // Readings as they are seen, but for some millimetres.
  const Network network = network_of(scene.problem);
  const auto there = network.blocks[0]->equations(Adjustment(network).start({0.7}), 0, 0.0);
  for (std::size_t i = 0; i < 2; ++i) {
    TargetFacts& target = scene.problem.observations[i].target;
    const double px_m = scene.problem.stations[0].model.geometry.camera.fy_px / target.distance_m;
    target.offset_m -= there.residuals[i].y() / px_m + 0.002 * static_cast<double>(i);
  }
  scene.expect_derivatives();
}

// Lines over each other tell from which side the board is seen; one alone does not.
TEST(LevelLineBlock, SeveralLinesTellHowTheBoardIsTurned) {
  const auto roll_information = [](const std::vector<Observation>& lines) {
    Scene scene;
    scene.problem.observations = lines;
    const Network network = network_of(scene.problem);
    const State state = Adjustment(network).start({0.7});
    return network.blocks[0]->equations(state, 0, 0.0).information(kMountX, kMountX);
  };
  const double one = roll_information({level_line({150.0, 100.0}, {1100.0, 100.0})});
  const double two = roll_information(
      {level_line({150.0, 100.0}, {1100.0, 100.0}), level_line({150.0, 800.0}, {1100.0, 800.0})});
  EXPECT_LT(1.0 / std::sqrt(two), 70.0 * kArcsec);
  EXPECT_GT(1.0 / std::sqrt(one), 300.0 * kArcsec);
}

TEST(CrossBlock, DoesNotDependOnWhereTheUnitLooks) {
  Scene scene;
  scene.problem.observations = {cross({812.0, 430.0})};
  const Network network = network_of(scene.problem);
  const State state = Adjustment(network).start({0.7});
  const auto information = network.blocks[0]->equations(state, 0, 0.0).information;
  EXPECT_GT(information(kMountZ, kMountZ), 1.0);
  for (const int k : {kHeading, kTiltX, kTiltY, kTrunnion, kPanCos1, kPanBacklash, kTiltCos1}) {
    EXPECT_EQ(information(k, k), 0.0) << k;
  }
}

TEST(RulerBlock, ARulerAloneIsRefused) {
  Scene scene;
  scene.problem.observations = {ruler("near", 20.0, {400.0, 479.5}),
                                ruler("other", 21.0, {900.0, 470.0})};
  EXPECT_THROW(network_of(scene.problem), ObservationRefused);
  scene.problem.observations = {ruler("near", 20.0, {400.0, 479.5}),
                                ruler("far", 40.0, {900.0, 470.0})};
  scene.problem.observations.push_back(scene.problem.observations[0]);
  scene.problem.observations[2].target.distance_m = 25.0;
  try {
    network_of(scene.problem);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_STREQ(refused.what(), "distance_m: 'near' has another distance already");
    EXPECT_EQ(refused.other(), 0U);
  }
}

}  // namespace
}  // namespace ols::calibration
