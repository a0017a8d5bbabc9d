#include "geometry/station_model.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/angles.h"
#include "geometry/pixel_prediction.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::near;

constexpr unsigned kSeed = 20260117;
constexpr double kArcsec = kPi / 648000.0;

StationModel crooked(std::mt19937& random) {
  std::normal_distribution<double> normal;
  StationModel model;
  model.geometry.position = {radians(49.2), radians(16.6), 300.0};
  ChainParameters& chain = model.geometry.chain;
  chain.heading_rad = radians(123.0);
  chain.azi_to_ele_m = {0.01, -0.02, 0.03};
  chain.pan_sign = normal(random) > 0.0 ? 1 : -1;
  chain.tilt_sign = normal(random) > 0.0 ? 1 : -1;
  chain.pan_zero_rad = 0.3;
  chain.tilt_zero_rad = -0.05;
  ModelParameters by;
  for (int k = 0; k < kModelParameters; ++k) by[k] = 3e-3 * normal(random);
  by[kFocal] *= 1e4;
  by[kCx] *= 1e4;
  by[kCy] *= 1e4;
  by[kK1] *= 20.0;
  by[kK2] *= 100.0;
  return changed(model, by);
}

UnitReading some_reading(std::mt19937& random) {
  std::uniform_real_distribution<double> pan(-49000.0, 49000.0), tilt(-2000.0, 9000.0);
  return {{pan(random), 4000.0, -1}, {tilt(random), -900.0, 1}};
}

// A target seen at the pixel, with this inverse distance.
HomogeneousPoint seen_at(const StationModel& model, const UnitReading& reading,
                         const Vector2d& pixel, double w) {
  const Eigen::Isometry3d camera =
      enu_from_camera(model.geometry.chain, corrected_angles(model, reading));
  const Vector3d ray = camera.linear() * *unproject(model.geometry.camera, pixel);
  return {ray + w * camera.translation(), w};
}

TEST(StationModel, WithoutErrorsItIsTheKinematicChain) {
  std::mt19937 random(kSeed);
  StationModel model;
  model.geometry.chain.pan_sign = -1;
  model.geometry.chain.heading_rad = 1.0;
  model.geometry.chain.pan_zero_rad = 0.2;
  for (int i = 0; i < 20; ++i) {
    const UnitReading reading = some_reading(random);
    const PanTilt angles = corrected_angles(model, reading);
    EXPECT_NEAR(angles.pan_rad, 2.0 * kPi * reading.pan.counts / 112000.0, 1e-15);
    EXPECT_NEAR(angles.tilt_rad, 2.0 * kPi * reading.tilt.counts / 112000.0, 1e-15);
    const Vector2d pixel(700.0, 300.0);
    const auto line = sight(model.geometry, {.pixel = pixel, .angles = angles});
    const auto found = predict_direction(model, reading, pixel);
    EXPECT_NEAR(found->direction.azimuth_rad, line->direction.azimuth_rad, 1e-6 * kArcsec + 1e-7);
    EXPECT_NEAR(found->direction.elevation_rad, line->direction.elevation_rad, 1e-7);
  }
}

TEST(StationModel, AnAxisHasTheErrorsOfItsGearsAndBearings) {
  AxisModel axis;
  axis.counts_per_turn = 1000;
  axis.worm_teeth = 4;
  axis.cos1_rad = 1e-3;
  axis.sin1_rad = 2e-3;
  axis.cos2_rad = 3e-3;
  axis.sin2_rad = 4e-3;
  axis.worm_cos_rad = 5e-3;
  axis.worm_sin_rad = 6e-3;
  axis.backlash_rad = 8e-3;
  // A sixteenth of a turn backwards, by 50 counts and what 125 counts/s do in 0.1 s.
  const double rad = shaft_angle(axis, -1, 0.0, {50.0, 125.0, -1}, 0.1).rad;
  const double eighth = std::sqrt(0.5), sixteenth = std::cos(kPi / 8.0);
  EXPECT_NEAR(
      rad + kPi / 8.0,
      1e-3 * sixteenth - 2e-3 * std::sin(kPi / 8.0) + 3e-3 * eighth - 4e-3 * eighth - 6e-3 - 4e-3,
      1e-15);
}

TEST(StationModel, TheTrunnionTiltsWhatATurnOfTiltMovesUp) {
  StationModel model;
  model.geometry.chain.heading_rad = 0.0;
  model.geometry.chain.trunnion_rad = 1e-3;
  // Raised by 45 degrees about an axis whose left end is up, the camera looks to the right.
  const auto found = predict_direction(model, {{}, {14000.0, 0.0, 1}}, {639.5, 479.5});
  EXPECT_NEAR(found->direction.azimuth_rad, 1e-3, 1e-6);
}

TEST(StationModel, AimFindsTheAnglesWithATrunnionError) {
  std::mt19937 random(kSeed);
  for (int i = 0; i < 50; ++i) {
    const ChainParameters chain = crooked(random).geometry.chain;
    const Vector3d wanted = Vector3d::Random().normalized();
    const auto angles = aim(chain, wanted);
    if (!angles) continue;
    const Vector3d axis = enu_from_camera(chain, *angles).linear().col(2);
    EXPECT_TRUE(near(axis, wanted, 1e-12));
  }
}

// Central differences of the pixel by each parameter.
TEST(PixelPrediction, ItsDerivativesAreThoseOfDifferences) {
  std::mt19937 random(kSeed);
  for (const double w : {1.0 / 200.0, 1.0 / 3.0}) {
    const StationModel model = crooked(random);
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
