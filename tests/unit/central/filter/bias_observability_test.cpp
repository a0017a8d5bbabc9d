#include "central/filter/bias_observability.h"

#include <gtest/gtest.h>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

// A station's rotation of 1 mrad per axis, measured with a noise of 0.1 mrad.
bool is_linear_at(double range_sd_m) {
  const RayFrame frame = ray_frame(test::ray_to("a", {0, 0, 0}, {0, 300, 50}).sight);
  const StationPart part{.first = 9,
                         .has_place = false,
                         .by_rotation = shift_by_rotation(frame.tangent),
                         .R_ecef_enu = Eigen::Matrix3d::Identity()};
  FilterMatrix P = FilterMatrix::Zero(13, 13);
  P.diagonal().segment<3>(9).setConstant(1e-6);
  return is_linear(part, frame, 300.0, range_sd_m * range_sd_m * Eigen::Matrix3d::Identity(), P,
                   1e-8 * Eigen::Matrix2d::Identity());
}

TEST(BiasObservability, NeedsARangeThatIsWellKnown) {
  EXPECT_TRUE(is_linear_at(0.5));
  EXPECT_FALSE(is_linear_at(30.0));
}

TEST(BiasObservability, NeedsMoreThanLinearisationMakesUp) {
  const Eigen::Vector3d along(0, 1, 0);
  FilterMatrix P = FilterMatrix::Zero(13, 13);
  P.diagonal().segment<3>(9).setConstant(1e-6);
  P(9, 1) = 0.9e-3 * 10.0;  // correlated with a depth of 10 m sd
  const StationPart part{.first = 9, .has_place = false, .by_rotation = {}, .R_ecef_enu = {}};
  FilterMatrix2 G = FilterMatrix2::Zero(13, 2);
  const double off_share = 1.0 / 300.0;
  EXPECT_FALSE(shows_bias(G, P, part, along, off_share));
  G.row(9) << 1e-3, 0.0;  // a sigma of the state
  EXPECT_TRUE(shows_bias(G, P, part, along, off_share));
}

}  // namespace
}  // namespace ols::fusion
