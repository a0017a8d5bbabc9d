#include "central/admission/bearing_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

BearingMeasurement good() {
  return test::measurement_of(test::ray_to("a", {0, 0, 0}, {100, 100, 50}), 1'600'000'000'000'000);
}

TEST(BearingCheck, TakesAGoodBearing) { EXPECT_EQ(check(good()), BearingRefusal::kNone); }

TEST(BearingCheck, NamesWhatIsWrong) {
  BearingMeasurement measurement = good();
  measurement.belief = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check(measurement), BearingRefusal::kNotFinite);
  measurement = good();
  measurement.station.clear();
  EXPECT_EQ(check(measurement), BearingRefusal::kOutOfRange);
  measurement = good();
  measurement.sight.origin_ecef.setZero();
  EXPECT_EQ(check(measurement), BearingRefusal::kOutOfRange);
  measurement = good();
  measurement.sight.covariance_white(0, 1) = measurement.sight.covariance_white(0, 0);
  EXPECT_EQ(check(measurement), BearingRefusal::kCovariance);
  measurement = good();
  measurement.sight.covariance_systematic(1, 1) = -1e-6;
  EXPECT_EQ(check(measurement), BearingRefusal::kCovariance);
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
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](M&) {}), BearingRefusal::kNone);
  EXPECT_EQ(refusal([](M& m) { m.sighted.rate_rad_s.x() = kNan; }), BearingRefusal::kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.sighted.signal = kNan; }), BearingRefusal::kNotFinite);
  EXPECT_EQ(refusal([](M& m) { m.image_bearings = -1; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_rad = -1e-3; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_rad = 4.0; }), BearingRefusal::kOutOfRange);
  EXPECT_EQ(refusal([](M& m) { m.sighted.size_sd_rad = -1e-3; }), BearingRefusal::kOutOfRange);
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
