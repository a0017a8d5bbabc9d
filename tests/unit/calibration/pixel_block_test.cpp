// The block of a target's sightings: calibration/block.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "calibration/block.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using Eigen::VectorXd;

// The gradient is half the derivative of the squares that are left with the best nuisance: of a
// landmark whose three coordinates are eliminated.
TEST(PixelBlock, ItsGradientIsThatOfItsSquares) {
  const StationModel truth = test::hill();
  Problem problem = test::landmarks_around(truth, truth, 2);
  problem.observations[0].pixel.x() += 2.0;
  problem.observations[1].pixel.y() -= 3.0;
  // A pose of its own would make the weights depend on the parameters.
  problem.stations.front().pose_sd_rad = 0.0;
  const Network network = network_of(problem);
  const StationPrior& prior = problem.stations.front();
  const auto equations = [&](int parameter, double by) {
    StationVector change = StationVector::Zero();
    change[parameter] = by;
    State state;
    state.stations = {station_at(prior, change)};
    state.nuisances.assign(network.blocks.size(), VectorXd());
    state.nuisances[0] = Eigen::Vector3d::Zero();
    return network.blocks[0]->equations(state, 0, 0.0);
  };
  const BlockEquations here = equations(kHeading, 0.0);
  ASSERT_GT(here.squares, 10.0);
  for (const int k :
       std::initializer_list<int>{kFocal, kCx, kMountZ, kTrunnion, kPanSin1, kTiltBacklash,
                                  kHeading, kTiltY, kUp, kRefraction}) {
    const double step = k == kFocal || k == kCx ? 1e-2 : k >= kEast ? 1e-3 : 1e-6;
    const double numeric =
        (equations(k, step).squares - equations(k, -step).squares) / (2.0 * step);
    const auto column = std::ranges::find(here.columns, k) - here.columns.begin();
    EXPECT_NEAR(2.0 * here.gradient[column], numeric, 1e-3 * std::abs(numeric) + 1e-2)
        << "parameter " << k;
  }
}

TEST(PixelBlock, OnlyWhatHasNoPriorCostsDegreesOfFreedom) {
  const auto degrees_of_freedom = [](TargetPtr target) {
    const std::vector<Sighting> sightings(5);
    return pixel_block(std::move(target), sightings, {.layout = {.stations = 1}})
        ->degrees_of_freedom();
  };
  EXPECT_EQ(degrees_of_freedom(fixed_target({{0, 0, 6.4e6}, 0.1})), 10);
  EXPECT_EQ(degrees_of_freedom(scene_target()), 10 - 2);
  EXPECT_EQ(degrees_of_freedom(unknown_target()), 10 - 3);
}

}  // namespace
}  // namespace ols::calibration
