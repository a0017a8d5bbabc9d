#include "geometry/pixel_prediction.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "tests/unit/geometry/crooked_station.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::crooked;
using test::near;
using test::seen_at;
using test::some_reading;

constexpr unsigned kSeed = 20260117;

// Central differences of the pixel by each parameter.
TEST(PixelPrediction, ItsDerivativesAreThoseOfDifferences) {
  std::mt19937 random(kSeed);
  for (const auto& [distance_inverse, lens] :
       {std::pair{1.0 / 200.0, LensModel::kPinhole}, std::pair{1.0 / 3.0, LensModel::kPinhole},
        std::pair{1.0 / 3.0, LensModel::kFisheye},
        std::pair{1.0 / 200.0, LensModel::kPolynomial}}) {
    const double w = distance_inverse;
    const StationModel model = crooked(random, lens);
    const UnitReading reading = some_reading(random);
    const HomogeneousPoint point = seen_at(model, reading, {300.0, 800.0}, w);
    const auto here = predict_pixel(model, reading, point);
    ASSERT_TRUE(here);
    EXPECT_TRUE(near(here->pixel, Vector2d(300.0, 800.0), 1e-6));
    for (int k = 0; k < kModelParameters; ++k) {
      const double step = k == kFocal || k == kCx || k == kCy || k >= kEast ? 1e-2 : 1e-6;
      const auto at = [&](double by) {
        const StationModel there = changed(model, by * ModelParameters::Unit(k));
        // The target stays: it is seen from the new place, by its horizon.
        HomogeneousPoint moved = point;
        if (k >= kEast) moved.x -= w * by * Vector3d::Unit(k - kEast);
        return predict_pixel(there, reading, moved)->pixel;
      };
      const Vector2d numeric = (at(step) - at(-step)) / (2.0 * step);
      const double scale = 1e-5 * (1.0 + numeric.norm());
      EXPECT_TRUE(near(here->by_parameters.col(k), numeric, scale)) << "parameter " << k;
    }
  }
}

TEST(PixelPrediction, ItsDerivativesByTheTargetAreThoseOfDifferences) {
  std::mt19937 random(kSeed + 1);
  const StationModel model = crooked(random);
  const UnitReading reading = some_reading(random);
  const HomogeneousPoint point = seen_at(model, reading, {300.0, 800.0}, 0.2);
  const auto here = predict_pixel(model, reading, point);
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 4; ++k) {
    const auto at = [&](double by) {
      HomogeneousPoint moved = point;
      (k < 3 ? moved.x[k] : moved.w) += by;
      return predict_pixel(model, reading, moved)->pixel;
    };
    const Vector2d numeric = (at(kStep) - at(-kStep)) / (2.0 * kStep);
    const Vector2d exact = k < 3 ? here->by_x.col(k).eval() : here->by_w;
    EXPECT_TRUE(near(exact, numeric, 1e-4 * (1.0 + numeric.norm()))) << "component " << k;
  }
}

TEST(DirectionPrediction, ItsDerivativesAreThoseOfDifferences) {
  std::mt19937 random(kSeed + 2);
  const StationModel model = crooked(random);
  const UnitReading reading = some_reading(random);
  const Vector2d pixel(900.0, 200.0);
  const auto here = predict_direction(model, reading, pixel);
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(here->direction);
  for (int k = 0; k < kEast; ++k) {
    const double step = k == kFocal || k == kCx || k == kCy ? 1e-2 : 1e-6;
    const auto at = [&](double by) {
      return enu_from_azimuth_elevation(
          predict_direction(changed(model, by * ModelParameters::Unit(k)), reading, pixel)
              ->direction);
    };
    const Vector2d numeric = tangent.transpose() * (at(step) - at(-step)) / (2.0 * step);
    EXPECT_TRUE(near(here->by_parameters.col(k), numeric, 1e-6 * (1.0 + numeric.norm())))
        << "parameter " << k;
  }
}

}  // namespace
}  // namespace ols
