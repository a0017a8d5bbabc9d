#include "sim/lens/zoom_truth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::sim {
namespace {

CameraIntrinsics widest() {
  CameraIntrinsics camera;
  camera.fx_px = camera.fy_px = 2000.0;
  return camera;
}

TEST(ZoomTruth, GoesFromEndToEnd) {
  const ZoomTruth truth(widest(), 10.0);
  EXPECT_EQ(truth.camera_at(0.0).fx_px, 2000.0);
  EXPECT_NEAR(truth.camera_at(1.0).fx_px, 20000.0, 1e-9);
  EXPECT_GT(truth.camera_at(0.5).fx_px, 2000.0 * std::sqrt(10.0)) << "it bends";
}

// The table's statement of itself covers the truth between its points too.
TEST(ZoomTruth, ACalibrationsDeviationsAreHonest) {
  constexpr int kSeeds = 40;
  double squares = 0.0;
  int places = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const ZoomTruth truth(widest(), 10.0);
    const ZoomTable table(truth.calibrated(0.002, static_cast<std::uint64_t>(seed)));
    for (double position = 0.03; position < 1.0; position += 0.11) {
      const ZoomPoint at = table.at(position, 0.0);
      const double error = at.camera.fx_px - truth.camera_at(position).fx_px;
      squares += std::pow(error / at.focal_sd_px, 2);
      ++places;
    }
  }
  EXPECT_LT(squares / places, 1.5);
  EXPECT_GT(squares / places, 0.3);
}

}  // namespace
}  // namespace ols::sim
