#include "central/admission/bearing_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

BearingMeasurement good() {
  return test::measurement_of(test::ray_to("a", {0, 0, 0}, {100, 100, 50}), 1'600'000'000'000'000);
}

TEST(BearingCheck, TakesAGoodBearing) { EXPECT_EQ(check(good()), BearingRefusal::kNone); }

TEST(BearingCheck, NamesWhatIsWrong) {
  const auto refusal = [](const auto& spoil) {
    BearingMeasurement measurement = good();
    spoil(measurement);
    return check(measurement);
  };
  using M = BearingMeasurement;
  using enum BearingRefusal;
  EXPECT_EQ(refusal([](M& m) { m.sight.direction.azimuth_rad = kNan; }), kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.sight.origin_ecef.x() = kNan; }), kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.belief = kNan; }), kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.station.clear(); }), kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sight.direction.azimuth_rad = 7.0; }), kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sight.direction.elevation_rad = -1.6; }), kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.belief = 1.5; }), kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sight.origin_ecef.setZero(); }), kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.utime_us = 0; }), kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sight.origin_sd_enu_m.x() = 1.1e6; }), kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.clock_sd_s = 1.1e4; }), kOutOfRange);
  for (const double rad2 : {0.0, 1e308, 1e-160, 11.0, 0.9e-18}) {
    EXPECT_EQ(refusal([&](M& m) { m.sight.covariance_white = Eigen::Matrix2d::Identity() * rad2; }),
              kCovariance);
  }
  EXPECT_EQ(refusal([](M& m) { m.sight.covariance_white(0, 1) = 1.0; }), kCovariance);
  EXPECT_EQ(refusal([](M& m) { m.sight.covariance_white.diagonal() << 1e-17, 1.0; }), kCovariance);
  EXPECT_EQ(refusal([](M& m) { m.sight.covariance_white << 1.0, 1.0, 1.0, 1.0 + 1e-9; }),
            kCovariance);
  EXPECT_EQ(refusal([](M& m) { m.sight.covariance_systematic(1, 1) = -1e-9; }), kCovariance);
  EXPECT_EQ(refusal([](M& m) { m.sight.aim_sd_rad = kNan; }), kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.sight.aim_sd_rad = -1e-9; }), kCovariance);
  EXPECT_EQ(refusal([](M& m) {
              m.sight.covariance_systematic.diagonal() << 4e-8, 9e-8;
              m.sight.aim_sd_rad = 2.5e-4;
            }),
            kCovariance)
      << "it is a part of each axis";
  for (const double rad2 : {1e308, 11.0}) {
    EXPECT_EQ(refusal([&](M& m) { m.sight.covariance_systematic(0, 0) = rad2; }), kCovariance);
  }
}

TEST(BearingCheck, NamesWhatIsWrongWithWhatADetectorSaw) {
  const auto refusal = [](const auto& change) {
    BearingMeasurement measurement = good();
    measurement.is_tracklet = true;
    measurement.image_bearings = 3;
    measurement.sighted = {.rate_rad_s = {0.01, -0.02},
                           .rate_covariance = Eigen::Matrix2d::Identity() * 1e-6,
                           .size_rad = 1e-3,
                           .size_sd_rad = 3e-4,
                           .signal = 12.0,
                           .class_probability = {0.1, 0.9}};
    change(measurement);
    return check(measurement);
  };
  using M = BearingMeasurement;
  EXPECT_EQ(refusal([](M&) {}), BearingRefusal::kNone);
  EXPECT_EQ(refusal([](M& m) { m.sighted.rate_rad_s.x() = kNan; }), BearingRefusal::kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.sighted.signal = kNan; }), BearingRefusal::kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.image_bearings = -1; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_rad = -1e-3; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_rad = 4.0; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_sd_rad = -1e-3; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_noise_rad = -1e-3; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_noise_rad = kNan; }), BearingRefusal::kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.sighted.signal = -1.0; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.rate_covariance(0, 1) = 2e-6; }),
            BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.class_probability = {kNan}; }),
            BearingRefusal::kOutOfRange);
}

TEST(BearingCheck, EachRefusalHasACounterOfItsOwn) {
  for (int i = 0; i < static_cast<int>(BearingRefusal::kCount); ++i) {
    for (int k = 0; k < i; ++k) {
      EXPECT_STRNE(to_string(static_cast<BearingRefusal>(i)),
                   to_string(static_cast<BearingRefusal>(k)));
    }
  }
}

}  // namespace
}  // namespace ols::fusion
