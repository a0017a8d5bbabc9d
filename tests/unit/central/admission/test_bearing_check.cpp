#include <gtest/gtest.h>

#include <limits>

#include "central/admission/bearing_check.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

BearingMeasurement good() {
  return test::sighting_of(test::ray_to("a", {0, 0, 0}, {100, 100, 50}), 1'600'000'000'000'000);
}

TEST(SightingCheck, TakesAGoodBearing) { EXPECT_EQ(check(good()), BearingRefusal::kNone); }

TEST(SightingCheck, NamesWhatIsWrong) {
  BearingMeasurement sighting = good();
  sighting.belief = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check(sighting), BearingRefusal::kNotFinite);
  sighting = good();
  sighting.station.clear();
  EXPECT_EQ(check(sighting), BearingRefusal::kOutOfRange);
  sighting = good();
  sighting.sight.origin_ecef.setZero();
  EXPECT_EQ(check(sighting), BearingRefusal::kOutOfRange);
  sighting = good();
  sighting.sight.covariance_white(0, 1) = sighting.sight.covariance_white(0, 0);
  EXPECT_EQ(check(sighting), BearingRefusal::kCovariance);
  sighting = good();
  sighting.sight.covariance_systematic(1, 1) = -1e-6;
  EXPECT_EQ(check(sighting), BearingRefusal::kCovariance);
}

TEST(SightingCheck, EachRefusalHasACounterOfItsOwn) {
  for (int i = 0; i <= static_cast<int>(BearingRefusal::kLowBelief); ++i) {
    for (int k = 0; k < i; ++k) {
      EXPECT_STRNE(to_string(static_cast<BearingRefusal>(i)),
                   to_string(static_cast<BearingRefusal>(k)));
    }
  }
}

}  // namespace
}  // namespace ols::fusion
