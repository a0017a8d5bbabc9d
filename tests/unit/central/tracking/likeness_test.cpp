#include "central/tracking/likeness.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

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

}  // namespace
}  // namespace ols::fusion
