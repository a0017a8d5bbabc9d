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
