#include "calibration/stationing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "geometry/angles.h"
#include "geometry/utm.h"
#include "tests/unit/error_text.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHighest_rad = radians(10.0);

// As it was set up, and as it is known before any landmark is sighted.
struct Case {
  StationGeometry truth, rough;
};

Case crooked_station() {
  Case c;
  StationGeometry& truth = c.truth;
  truth.position = {radians(49.2), radians(16.6), 300.0};
  truth.chain.heading_rad = radians(211.0);
  truth.chain.tilt_x_rad = radians(0.2);
  truth.chain.tilt_y_rad = radians(-0.3);
  truth.chain.mount_z_rad = radians(0.4);
  truth.chain.mount_x_rad = radians(-0.5);
  truth.chain.mount_y_rad = radians(0.1);
  truth.camera.k1 = -0.2;
  c.rough = truth;
  c.rough.chain.heading_rad = radians(40.0);
  c.rough.chain.tilt_x_rad = c.rough.chain.tilt_y_rad = 0.0;
  c.rough.chain.mount_z_rad = c.rough.chain.mount_x_rad = c.rough.chain.mount_y_rad = 0.0;
  c.rough.sd = {.tilt_rad = radians(0.3),
                .mount_rad = radians(0.4),
                .mount_roll_rad = radians(0.5),
                .position_m = 0.0};
  return c;
}

// Where the landmark appears when the camera points to about it.
LandmarkSighting sighting(const StationGeometry& truth, const Vector3d& landmark_enu,
                          const Vector2d& near_px = {700.0, 400.0}) {
  LandmarkSighting s;
  s.landmark_ecef = LocalFrame(truth.position).to_ecef(landmark_enu);
  s.pixel = near_px;
  s.pixel_sd_px = 0.1;
  s.angles = aim_at(truth, s.landmark_ecef, near_px).value();
  return s;
}

std::vector<LandmarkSighting> all_around(const StationGeometry& truth) {
  return {sighting(truth, {800, 300, 40}), sighting(truth, {-500, 900, 10}, {300, 800}),
          sighting(truth, {-1500, -700, 90}), sighting(truth, {200, -400, 5}, {1000, 500}),
          sighting(truth, {100, 350, 120})};
}

// By how much the two stations disagree about where a camera at these angles looks.
Vector2d disagreement(const StationGeometry& a, const StationGeometry& b, const PanTilt& angles) {
  const AzimuthElevation direction = optical_axis(a, angles);
  return tangent_basis(direction).transpose() * enu_from_azimuth_elevation(optical_axis(b, angles));
}

TEST(Stationing, FindsThePoseFromLandmarksWhateverTheHeadingWas) {
  const Case c = crooked_station();
  const Stationing found = station_by_landmarks(c.rough, all_around(c.truth), kHighest_rad);
  for (const double azimuth_deg : {10.0, 95.0, 190.0, 300.0}) {
    const auto angles = aim_along(c.truth, {radians(azimuth_deg), radians(3.0)}).value();
    EXPECT_LT(disagreement(c.truth, found.station, angles).norm(), 2e-5) << azimuth_deg;
  }
  for (const Vector2d& r : found.residuals) EXPECT_LT(r.norm(), 0.5);
}

TEST(Stationing, OneLandmarkIsEnoughForAHeading) {
  Case c = crooked_station();
  c.rough.chain = c.truth.chain;
  c.rough.chain.heading_rad = radians(300.0);
  c.rough.sd = {};
  const Stationing found =
      station_by_landmarks(c.rough, {{sighting(c.truth, {400, 300, 0})}}, kHighest_rad);
  EXPECT_NEAR(found.station.chain.heading_rad, c.truth.chain.heading_rad, 1e-9);
  // A tenth of a pixel of 75 microradians.
  EXPECT_NEAR(found.station.sd.heading_rad, 0.1 * 75e-6, 1e-8);
  EXPECT_EQ(found.station.chain.tilt_x_rad, c.truth.chain.tilt_x_rad);
}

TEST(Stationing, LandmarksInUtmGiveATrueHeadingWhereGridNorthIsAnother) {
  Case c = crooked_station();
  std::vector<LandmarkSighting> sightings = all_around(c.truth);
  for (LandmarkSighting& s : sightings) {
    const Geodetic place = geodetic_from_ecef(s.landmark_ecef);
    const UtmPoint utm = utm_from_geodetic(place);
    EXPECT_NEAR(degrees(utm.convergence_rad), 1.21, 0.02);
    s.landmark_ecef = ecef_from_geodetic(geodetic_from_utm(utm.position, place.height_m));
  }
  const Stationing found = station_by_landmarks(c.rough, sightings, kHighest_rad);
  const auto angles = aim_along(c.truth, {0.0, 0.0}).value();
  EXPECT_LT(degrees(disagreement(c.truth, found.station, angles).norm()), 0.002);
}

struct Drawn {
  StationGeometry truth;
  std::vector<LandmarkSighting> sightings;
};

// Tilts, mounting, position, pixels and the register's coordinates are off as stated.
Drawn draw(const StationGeometry& rough, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  Drawn d{rough, {}};
  ChainParameters& chain = d.truth.chain;
  chain.heading_rad = 3.0 * normal(generator);
  chain.tilt_x_rad += rough.sd.tilt_rad * normal(generator);
  chain.tilt_y_rad += rough.sd.tilt_rad * normal(generator);
  chain.mount_z_rad += rough.sd.mount_rad * normal(generator);
  chain.mount_y_rad += rough.sd.mount_rad * normal(generator);
  chain.mount_x_rad += rough.sd.mount_roll_rad * normal(generator);
  const auto vector = [&](double sd) -> Vector3d {
    return sd * Vector3d(normal(generator), normal(generator), normal(generator));
  };
  d.truth.position =
      geodetic_from_ecef(LocalFrame(rough.position).to_ecef(vector(rough.sd.position_m)));
  for (LandmarkSighting s : all_around(d.truth)) {
    s.landmark_sd_m = 0.1;
    s.landmark_ecef += vector(s.landmark_sd_m);
    s.pixel += s.pixel_sd_px * Vector2d(normal(generator), normal(generator));
    d.sightings.push_back(s);
  }
  return d;
}

TEST(Stationing, IsAsWrongAsItSays) {
  constexpr int kDraws = 300;
  StationGeometry rough = crooked_station().rough;
  rough.sd = {.tilt_rad = radians(0.05),
              .mount_rad = radians(0.1),
              .mount_roll_rad = radians(0.2),
              .position_m = 0.02};
  std::mt19937_64 generator(5);
  double cross = 0.0, up = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Drawn d = draw(rough, generator);
    const Stationing found = station_by_landmarks(rough, d.sightings, kHighest_rad);
    const PanTilt angles = aim_along(d.truth, {radians(30.0 * i), 0.02}).value();
    const Vector2d off = disagreement(d.truth, found.station, angles);
    cross += std::pow(off.x() / found.station.sd.heading_rad, 2) / kDraws;
    up += std::pow(off.y() / found.station.sd.tilt_rad, 2) / kDraws;
  }
  // What is stated covers every line up to ten degrees: near the horizon the mean is below one.
  EXPECT_GT(cross, 0.6);
  EXPECT_LT(cross, 1.1);
  EXPECT_GT(up, 0.5);
  EXPECT_LT(up, 1.1);
}

TEST(Stationing, ImprovesAPositionThatWasReadOnAMap) {
  constexpr int kDraws = 100;
  StationGeometry rough = crooked_station().rough;
  rough.sd = {.tilt_rad = radians(0.05), .mount_rad = radians(0.1), .position_m = 2.0};
  std::mt19937_64 generator(6);
  double square_m2 = 0.0, by_stated = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Drawn d = draw(rough, generator);
    const Stationing found = station_by_landmarks(rough, d.sightings, kHighest_rad);
    EXPECT_EQ(found.station.position.latitude_rad, rough.position.latitude_rad);
    const Vector3d off = ecef_from_geodetic(found.position) - ecef_from_geodetic(d.truth.position);
    square_m2 += off.squaredNorm() / (3.0 * kDraws);
    by_stated += off.squaredNorm() / (3.0 * std::pow(found.position_sd_m, 2) * kDraws);
  }
  EXPECT_LT(std::sqrt(square_m2), 0.5);
  // The worst axis is stated for all.
  EXPECT_GT(by_stated, 0.2);
  EXPECT_LT(by_stated, 1.1);
}

TEST(Stationing, LandmarksTakeInTheMountingAndTheMoreTheNearerToTheHorizon) {
  Case c = crooked_station();
  // A tilt or a roll would show the mounting about the vertical.
  c.truth.chain.tilt_x_rad = c.truth.chain.tilt_y_rad = c.truth.chain.mount_x_rad = 0.0;
  c.rough.sd = {.mount_rad = radians(0.4)};
  const std::vector<LandmarkSighting> sightings = {sighting(c.truth, {800, 300, 10}),
                                                   sighting(c.truth, {-500, 900, 5}),
                                                   sighting(c.truth, {-1500, -700, 20})};
  const auto stated = [&](double highest_deg) {
    return degrees(
        station_by_landmarks(c.rough, sightings, radians(highest_deg)).station.sd.heading_rad);
  };
  EXPECT_LT(stated(5.0), 0.01);
  EXPECT_GT(stated(60.0), 0.1);
  EXPECT_EQ(station_by_landmarks(c.rough, sightings, 0.1).station.sd.mount_rad, 0.0);
}

std::string refusal(const StationGeometry& rough, std::vector<LandmarkSighting> sightings) {
  return error_text<std::invalid_argument>(
      [&] { station_by_landmarks(rough, sightings, kHighest_rad); });
}

TEST(Stationing, RefusesWhatIsNoSighting) {
  const Case c = crooked_station();
  const auto good = all_around(c.truth);
  EXPECT_THAT(refusal(c.rough, {}), testing::HasSubstr("no landmark"));
  auto bad = good;
  bad[1].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(c.rough, bad), testing::HasSubstr("sighting 2: pixel: not a finite"));
  bad = good;
  bad[2].angles.pan_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(c.rough, bad), testing::HasSubstr("sighting 3: angles: not a finite"));
  bad = good;
  bad[0].pixel_sd_px = 0.0;
  EXPECT_THAT(refusal(c.rough, bad), testing::HasSubstr("sighting 1: deviation: must be positive"));
  bad = good;
  bad[4].landmark_ecef = camera_centre_ecef(c.rough, bad[4].angles);
  EXPECT_THAT(refusal(c.rough, bad), testing::HasSubstr("sighting 5: landmark: is at the station"));
  bad = good;
  bad[3].landmark_ecef = ecef_from_geodetic({radians(16.6), radians(49.2), 300.0});
  EXPECT_THAT(refusal(c.rough, bad), testing::HasSubstr("sighting 4: landmark: is 4"));
}

TEST(Stationing, RefusesWhatLeavesTheHeadingUnknown) {
  const Case c = crooked_station();
  LandmarkSighting near = sighting(c.truth, {4.0, 3.0, 1.0});
  near.landmark_sd_m = 5000.0;
  EXPECT_THROW(station_by_landmarks(c.rough, {{near}}, kHighest_rad), std::invalid_argument);
  const auto sightings = all_around(c.truth);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(station_by_landmarks(c.rough, sightings, nan), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
