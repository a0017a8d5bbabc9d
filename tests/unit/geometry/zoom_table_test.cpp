#include "geometry/zoom_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "tests/unit/error_text.h"

namespace ols {
namespace {

ZoomPoint point(double position, double focal_px, double sd_px = 0.0) {
  ZoomPoint p;
  p.position = position;
  p.camera.fx_px = p.camera.fy_px = focal_px;
  p.focal_sd_px = sd_px;
  p.centre_sd_px = 1.0;
  return p;
}

TEST(ZoomTable, BetweenItsPointsTheFocalLengthGoesByItsLogarithm) {
  const ZoomTable table({point(0.0, 1000.0, 1.0), point(1.0, 16000.0, 32.0)});
  const ZoomPoint half = table.at(0.5, 0.0);
  EXPECT_NEAR(half.camera.fx_px, 4000.0, 1e-9);
  EXPECT_NEAR(half.focal_sd_px, 4000.0 * 2e-3, 1e-9) << "the worse neighbour's share";
  EXPECT_EQ(half.centre_sd_px, 1.0);
  EXPECT_NEAR(table.at(0.25, 0.0).camera.fy_px, 2000.0, 1e-9);
}

TEST(ZoomTable, EveryCoefficientIsInterpolated) {
  ZoomPoint wide = point(0.0, 1000.0), narrow = point(1.0, 16000.0);
  const auto coefficients = [](CameraIntrinsics& camera) {
    return std::array{&camera.cx_px, &camera.cy_px, &camera.skew, &camera.k1, &camera.k2,
                      &camera.p1,    &camera.p2,    &camera.k3,   &camera.k4};
  };
  double value = 0.0;
  for (double* one : coefficients(wide.camera)) *one = value += 1.0;
  for (double* one : coefficients(narrow.camera)) *one = value += 3.0;
  ZoomPoint half = ZoomTable({wide, narrow}).at(0.5, 0.0);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(*coefficients(half.camera)[i],
                0.5 * (*coefficients(wide.camera)[i] + *coefficients(narrow.camera)[i]), 1e-9)
        << i;
  }
}

TEST(ZoomTable, APositionsErrorIsAFocalLengthsError) {
  const ZoomTable table({point(0.0, 1000.0), point(1.0, 16000.0)});
  EXPECT_NEAR(table.at(0.5, 0.01).focal_sd_px, 4000.0 * std::log(16.0) * 0.01, 1e-9);
}

// What a table with few points does not know of a lens that bends, it says.
TEST(ZoomTable, StatesWhatBendsBetweenItsPoints) {
  const auto truth = [](double z) { return 1000.0 * std::exp(1.0 * z + 1.5 * z * z); };
  std::vector<ZoomPoint> points;
  for (int i = 0; i <= 5; ++i) points.push_back(point(0.2 * i, truth(0.2 * i)));
  const ZoomTable table(points);
  for (double z = 0.0; z <= 1.0; z += 0.01) {
    const ZoomPoint at = table.at(z, 0.0);
    EXPECT_LE(std::abs(at.camera.fx_px - truth(z)), 1.1 * at.focal_sd_px + 1e-6) << z;
  }
  EXPECT_NEAR(table.at(0.4, 0.0).focal_sd_px, 0.0, 1e-9) << "nothing at a point itself";
}

TEST(ZoomTable, OutsideItIsTheNearestPoint) {
  const ZoomTable table({point(0.1, 1000.0), point(0.9, 2000.0)});
  EXPECT_NEAR(table.at(0.0, 0.0).camera.fx_px, 1000.0, 1e-9);
  EXPECT_NEAR(table.at(1.0, 0.0).camera.fx_px, 2000.0, 1e-9);
}

TEST(ZoomTable, RefusesWhatIsNoTable) {
  const auto refusal = [](std::vector<ZoomPoint> points) -> std::string {
    return error_text<std::invalid_argument>(
        [&] { static_cast<void>(ZoomTable(std::move(points))); }, "taken");
  };
  EXPECT_EQ(refusal({point(0.0, 1000.0)}), "needs at least two points");
  EXPECT_EQ(refusal({point(0.5, 1000.0), point(0.5, 2000.0)}), "point 2: positions must rise");
  EXPECT_EQ(refusal({point(0.0, 1000.0), point(1.0, 900.0)}), "point 2: focal lengths must rise");
  EXPECT_EQ(refusal({point(0.0, 1000.0), point(1.1, 2000.0)}),
            "point 2: position is outside 0 .. 1");
  EXPECT_EQ(refusal({point(0.0, -1.0), point(1.0, 2000.0)}),
            "point 1: the focal length must be positive");
}

}  // namespace
}  // namespace ols
