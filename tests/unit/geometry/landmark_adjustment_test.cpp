#include "geometry/landmark_adjustment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "geometry/angles.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

StationGeometry station() {
  StationGeometry geometry;
  geometry.position = {radians(49.2), radians(16.6), 300.0};
  geometry.chain.heading_rad = radians(30.0);
  geometry.sd = {.tilt_rad = 1e-3, .mount_rad = 2e-3, .mount_roll_rad = 3e-3, .position_m = 0.1};
  return geometry;
}

LandmarkSighting sighting(const StationGeometry& from, const Vector3d& landmark_enu,
                          const Vector2d& near_px = {700.0, 400.0}) {
  LandmarkSighting s;
  s.landmark_ecef = LocalFrame(from.position).to_ecef(landmark_enu);
  s.landmark_sd_m = 0.05;
  s.pixel = near_px;
  s.pixel_sd_px = 0.2;
  s.angles = aim_at(from, s.landmark_ecef, near_px).value();
  s.angles_sd_rad = 2e-5;
  return s;
}

const Vector3d kTower{800.0, 300.0, 40.0}, kMast{-500.0, 900.0, 10.0};

TEST(LandmarkAdjustment, SightingsOfOnePlaceAreOneLandmark) {
  const std::vector<LandmarkSighting> sightings{sighting(station(), kTower),
                                                sighting(station(), kMast),
                                                sighting(station(), kTower, {300.0, 600.0})};
  const LandmarkAdjustment adjustment(station(), sightings);
  ASSERT_EQ(adjustment.landmarks().size(), 2U);
  EXPECT_EQ(adjustment.landmarks()[0], (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(adjustment.landmarks()[1], (std::vector<std::size_t>{1}));
}

// They share the error of its coordinates, which no repetition averages out.
TEST(LandmarkAdjustment, RepeatedSightingsAreNoBetterThanTheLandmark) {
  const LandmarkSighting one = sighting(station(), kTower);
  const auto shift_information = [](std::size_t times) {
    const std::vector<LandmarkSighting> sightings(times, sighting(station(), kTower));
    return LandmarkAdjustment(station(), sightings)
        .fit({true}, station().chain.heading_rad)
        .landmarks[0]
        .shift_information;
  };
  const double distance_m = LandmarkAdjustment(station(), std::vector{one}).distance_m(0);
  const double most = std::pow(distance_m / one.landmark_sd_m, 2);
  EXPECT_GT(shift_information(20), shift_information(1));
  EXPECT_LT(shift_information(1000), most);
  EXPECT_GT(shift_information(1000), 0.99 * most);
}

TEST(LandmarkAdjustment, AResidualIsTheAngleByWhichTheLineMisses) {
  StationGeometry turned = station();
  const std::vector<LandmarkSighting> sightings{sighting(station(), {1000.0, 0.0, 0.0})};
  const LandmarkAdjustment adjustment(station(), sightings);
  EXPECT_LT(adjustment.residual(turned, 0).norm(), 1e-9);
  turned.chain.heading_rad += radians(2.0);
  const Vector2d missed = adjustment.residual(turned, 0);
  EXPECT_NEAR(missed.norm(), radians(2.0), 1e-4);
  EXPECT_LT(std::abs(missed.y()), 1e-3) << "across, not up";
  turned.chain.heading_rad = station().chain.heading_rad + kPi;
  EXPECT_NEAR(adjustment.residual(turned, 0).norm(), kPi, 0.02) << "the other side is no hit";
}

TEST(LandmarkAdjustment, FitsTheHeadingFromAnywhere) {
  StationGeometry rough = station();
  const std::vector<LandmarkSighting> sightings{sighting(station(), kTower),
                                                sighting(station(), kMast)};
  rough.chain.heading_rad = radians(200.0);
  const LandmarkAdjustment adjustment(rough, sightings);
  // Not exactly: the camera turns about the tripod's axis, a little beside it.
  EXPECT_NEAR(adjustment.heading_by(0), radians(30.0), 1e-4);
  const LandmarkFit fit = adjustment.fit({true, true}, adjustment.heading_by(1));
  EXPECT_NEAR(fit.station.chain.heading_rad, radians(30.0), 1e-7);
  EXPECT_LT(fit.misfit, 1e-6);
}

TEST(LandmarkAdjustment, TheUnknownsAreInUnitsOfTheirDeviations) {
  const LandmarkAdjustment adjustment(station(), std::vector{sighting(station(), kTower)});
  EXPECT_EQ(adjustment.scale()[1], 1e-3);
  EXPECT_EQ(adjustment.scale()[8], 0.1);
  PoseUnknowns by = PoseUnknowns::Zero();
  by[3] = 2e-3;
  EXPECT_EQ(changed(station(), by).chain.mount_z_rad, station().chain.mount_z_rad + 2e-3);
  EXPECT_EQ(changed(station(), by).chain.heading_rad, station().chain.heading_rad);
}

TEST(LandmarkAdjustment, ASightingThatCannotBeIsRefusedByItsNumber) {
  std::vector<LandmarkSighting> sightings{sighting(station(), kTower), sighting(station(), kMast)};
  const auto refused = [&](const LandmarkSighting& bad) {
    try {
      sightings[1] = bad;
      const LandmarkAdjustment adjustment(station(), sightings);
    } catch (const LandmarkRefused& why) {
      return std::to_string(why.sighting()) + " " + why.field();
    }
    return std::string("accepted");
  };
  LandmarkSighting bad = sighting(station(), kMast);
  EXPECT_EQ(refused(bad), "accepted");
  bad.angles.pan_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(bad), "1 angles");
  bad = sighting(station(), kMast);
  bad.pixel_sd_px = bad.angles_sd_rad = 0.0;
  EXPECT_EQ(refused(bad), "1 deviation");
  bad = sighting(station(), kMast);
  bad.landmark_ecef = LocalFrame(station().position).to_ecef({300e3, 0.0, 0.0});
  EXPECT_EQ(refused(bad), "1 landmark") << "of another zone";
}

}  // namespace
}  // namespace ols
