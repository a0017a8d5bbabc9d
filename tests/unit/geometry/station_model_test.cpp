#include "geometry/station_model.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/angles.h"
#include "tests/unit/geometry/crooked_station.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::crooked;
using test::near;
using test::some_reading;

constexpr unsigned kSeed = 20260117;
constexpr double kArcsec = kPi / 648000.0;

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

}  // namespace
}  // namespace ols
