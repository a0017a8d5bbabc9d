#include "central/tracking/likeness.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "central/tracking/appearance.h"
#include "central/tracking/target_appearance.h"
#include "tests/unit/central/flight.h"
#include "tests/unit/central/ground/lands.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using namespace test;

TrackFilter filter_at(double east_m, double sd_m) {
  return {
      {},
      kStart,
      {.p_ecef = site().to_ecef({east_m, 300, 50}), .position_sd_m = sd_m, .velocity_sd_m_s = 1.0}};
}

// Two positions with the same sigma per axis differ with its root of two; one in a hundred exceeds
// a chi-square of 11.345: 4.763 sigmas.
TEST(Similarity, OnePlaceInAHundredIsTakenForAnother) {
  const KinematicState here = filter_at(0.0, 1.0).summary();
  EXPECT_TRUE(is_same_place(here, filter_at(4.76, 1.0).summary()));
  EXPECT_FALSE(is_same_place(here, filter_at(4.77, 1.0).summary()));
}

// With six degrees of freedom, one in a thousand exceeds 22.458: 6.702 sigmas.
TEST(Similarity, OneMotionInAThousandIsTakenForAnother) {
  EXPECT_TRUE(are_duplicates(filter_at(0.0, 1.0), filter_at(6.70, 1.0)));
  EXPECT_FALSE(are_duplicates(filter_at(0.0, 1.0), filter_at(6.71, 1.0)));
}

const Eigen::Vector3d kObject(0.0, 300.0, 80.0), kVelocity(3.0, -2.0, 4.0);

// What a station sees of an object with this velocity, 0.5 m large.
BearingMeasurement seen_from(const Eigen::Vector3d& p_enu,
                             const Eigen::Vector3d& v_enu = kVelocity) {
  constexpr double kStepS = 0.01;
  BearingMeasurement m = test::measurement_of(test::ray_to("a", p_enu, kObject), 1);
  const auto at = [&](double t) {
    return test::direction_to(m.sight.origin_ecef, test::site().to_ecef(kObject + t * v_enu));
  };
  const AzimuthElevation from = at(-kStepS), to = at(kStepS);
  m.sighted.rate_rad_s =
      Eigen::Vector2d((to.azimuth_rad - from.azimuth_rad) * std::cos(from.elevation_rad),
                      to.elevation_rad - from.elevation_rad) /
      (2.0 * kStepS);
  m.sighted.rate_covariance = 1e-6 * Eigen::Matrix2d::Identity();
  const double range_m = (kObject - p_enu).norm();
  m.sighted.size_rad = 0.5 / range_m;
  m.sighted.size_sd_rad = 1e-4;
  m.sighted.signal = 1e6 / (range_m * range_m);
  return m;
}

const Eigen::Vector3d kA(-300.0, 10.0, 0.0), kB(100.0, 0.0, 20.0);

bool are_one(const BearingMeasurement& a, const BearingMeasurement& b) {
  const Eigen::Vector3d normal =
      (b.sight.origin_ecef - a.sight.origin_ecef).cross(direction_ecef(a.sight)).normalized();
  return may_be_same_object(a, (kObject - kA).norm(), b, (kObject - kB).norm(), normal);
}

TEST(Appearance, OfOneObjectAgrees) { EXPECT_TRUE(are_one(seen_from(kA), seen_from(kB))); }

TEST(Appearance, TwoThatLeaveThePlaneDifferentlyAreTwo) {
  EXPECT_FALSE(are_one(seen_from(kA), seen_from(kB, {3.0, -2.0, -4.0})));
}

TEST(Appearance, ASizeOrBrightnessFarFromTheOtherIsOfAnother) {
  const BearingMeasurement a = seen_from(kA);
  BearingMeasurement b = seen_from(kB);
  b.sighted.size_rad *= 8.0;
  EXPECT_FALSE(are_one(a, b));
  b = seen_from(kB);
  b.sighted.signal *= 40.0;
  EXPECT_FALSE(are_one(a, b));
  b.sighted.signal = 0.0;
  EXPECT_TRUE(are_one(a, b)) << "unknown";
}

TEST(Appearance, TheRateOfATargetIsItsVelocityAcross) {
  KinematicState state;
  state.mean.setZero();
  state.mean.head<3>() = test::site().to_ecef(kObject);
  state.mean.segment<3>(3) = test::site().to_ecef(kObject + kVelocity) - state.mean.head<3>();
  state.covariance = 0.01 * Eigen::Matrix<double, 9, 9>::Identity();
  EXPECT_LT(rate_nis(seen_from(kA), state), 0.01);
  EXPECT_GT(rate_nis(seen_from(kA, {3.0, -2.0, -20.0}), state), 25.0);
  BearingMeasurement without = seen_from(kA, {3.0, -2.0, -20.0});
  without.sighted = {};
  EXPECT_EQ(rate_nis(without, state), 0.0);
}

const Eigen::Vector3d kThere_enu{0.0, 0.0, 100.0};

// Seen by a station 100 m and one 200 m below it.
Track seen_by_two(const Sighted& near, const Sighted& far) {
  Track track(TrackFilter({}, 1, {.p_ecef = test::site().to_ecef(kThere_enu)}));
  const auto add = [&](const std::string& station, double up_m, const Sighted& seen) {
    BearingMeasurement m =
        test::measurement_of(test::ray_to(station, {0.0, 0.0, up_m}, kThere_enu), 1);
    m.sighted = seen;
    track.bearings[station].push_back(m);
    track.last.note(m);
  };
  add("near", 0.0, near);
  add("far", -100.0, far);
  return track;
}

Appearance appearance(const Sighted& near, const Sighted& far) {
  return appearance_of(seen_by_two(near, far), test::site().to_ecef(kThere_enu));
}

TEST(TargetAppearance, SizesWeighByTheirVarianceInMetres) {
  // 1 m +- 0.1 m, and 2 m +- 0.2 m.
  const Appearance seen = appearance({.size_rad = 0.01, .size_sd_rad = 0.001, .signal = 5.0},
                                     {.size_rad = 0.01, .size_sd_rad = 0.001, .signal = 9.0});
  EXPECT_NEAR(seen.size_m, (1.0 * 100.0 + 2.0 * 25.0) / 125.0, 1e-6);
  EXPECT_NEAR(seen.size_sd_m, 1.0 / std::sqrt(125.0), 1e-7);
  EXPECT_EQ(seen.signal, 9.0);
  EXPECT_EQ(seen.object_class, ObjectClass::kUnknown);
}

TEST(TargetAppearance, ClassesOfBothStationsMultiply) {
  const Appearance seen = appearance({.class_probability = {0.0, 0.6, 0.4, 0.0, 0.0}},
                                     {.class_probability = {0.0, 0.2, 0.8, 0.0, 0.0}});
  EXPECT_EQ(seen.object_class, ObjectClass::kBird);
  EXPECT_NEAR(seen.class_probability, 0.32 / (0.32 + 0.12), 1e-4);
}

// Of what is 35 m long, by five seconds of this velocity; the size is that of the station that sees
// it best.
Appearance flown(const Eigen::Vector3d& velocity_enu_m_s, double size_rad = 0.35,
                 const land::Surface* land = nullptr) {
  Track track = seen_by_two({.size_rad = size_rad, .size_sd_rad = 0.06 * size_rad},
                            {.size_rad = 0.01, .size_sd_rad = 0.3});
  const Eigen::Vector3d there = test::site().to_ecef(kThere_enu);
  EXPECT_EQ(appearance_of(track, there).object_class, ObjectClass::kUnknown);
  for (int i = 0; i <= 25; ++i) {
    const std::int64_t utime_us = 1 + i * 200'000LL;
    for (auto& [station, own] : track.bearings) {
      own.back().utime_us = utime_us;
      track.last.note(own.back());
    }
    track.filter = TrackFilter(
        {}, utime_us,
        {.p_ecef = there,
         .v_ecef = test::site().to_ecef(velocity_enu_m_s) - test::site().to_ecef({0.0, 0.0, 0.0}),
         .position_sd_m = 1.0,
         .velocity_sd_m_s = 1.0});
    look_at_class(track, land);
    look_at_class(track, land);  // again at once: no look
  }
  EXPECT_EQ(track.velocities.size(), 6u);
  return appearance_of(track, there);
}

TEST(TargetAppearance, ClassIsThatOfTheTracksLifeWhereverItFlies) {
  const Appearance east = flown({150.0, 0.0, 0.0}), north = flown({0.0, 150.0, 0.0});
  EXPECT_EQ(east.object_class, ObjectClass::kAircraft);
  EXPECT_GE(east.class_probability, kSure);
  EXPECT_NEAR(north.class_probability, east.class_probability, 1e-6);
  EXPECT_GT(std::abs(flown({0.0, 0.0, 150.0}).class_probability - east.class_probability), 1e-5);
}

TEST(TargetAppearance, AStationThatNoLongerSeesTheTargetSaysNothingOfItsClass) {
  const Sighted seen{.size_rad = 0.01, .size_sd_rad = 0.001};
  Track track = seen_by_two(seen, seen);
  const auto is_looked_at = [&](std::int64_t utime_us) {
    track.filter = TrackFilter({}, utime_us, {.p_ecef = test::site().to_ecef(kThere_enu)});
    track.classes = {};
    look_at_class(track, nullptr);
    return track.classes.has_looked();
  };
  EXPECT_TRUE(is_looked_at(900'000));
  EXPECT_FALSE(is_looked_at(1'200'000));
}

// 9 m long, at 20 m/s.
TEST(TargetAppearance, WhatDrivesOnAHillIsNoHelicopter) {
  const Land hill([](double, double) { return 349.0; }, 1.0, test::site().origin());
  const Eigen::Vector3d velocity(20.0, 0.0, 0.0);
  EXPECT_EQ(flown(velocity, 0.09).object_class, ObjectClass::kAircraft) << "100 m above a station";
  EXPECT_EQ(flown(velocity, 0.09, &hill).object_class, ObjectClass::kOther);
}

TEST(TargetAppearance, BelowAStationOnAHillTheHeightIsUnknown) {
  const Eigen::Vector3d there = test::site().to_ecef(kThere_enu);
  Track track(TrackFilter({}, 1, {.p_ecef = there}));
  BearingMeasurement seen =
      test::measurement_of(test::ray_to("hill", {0.0, 0.0, 350.0}, kThere_enu), 1);
  seen.sighted = {.size_rad = 0.002, .size_sd_rad = 0.0002};
  track.bearings["hill"].push_back(seen);
  track.last.note(seen);
  for (int i = 0; i <= 25; ++i) {
    const std::int64_t utime_us = 1 + i * 200'000LL;
    for (auto& [station, own] : track.bearings) {
      own.back().utime_us = utime_us;
      track.last.note(own.back());
    }
    track.filter = TrackFilter(
        {}, utime_us,
        {.p_ecef = there,
         .v_ecef = test::site().to_ecef({1.0, 0.0, 4.0}) - test::site().to_ecef({0.0, 0.0, 0.0}),
         .position_sd_m = 1.0,
         .velocity_sd_m_s = 0.3});
    look_at_class(track, nullptr);
  }
  EXPECT_EQ(appearance_of(track, there).object_class, ObjectClass::kDrone);
}

TEST(TargetAppearance, NothingSeenIsUnknown) {
  const Appearance seen = appearance({}, {});
  EXPECT_EQ(seen.size_m, 0.0);
  EXPECT_EQ(seen.size_sd_m, 0.0);
  EXPECT_EQ(seen.class_probability, 0.0);
}

}  // namespace
}  // namespace ols::fusion
