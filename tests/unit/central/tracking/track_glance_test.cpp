#include "central/tracking/track_glance.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using namespace test;
using Eigen::Vector3d;

bool may_see(const Vector3d& looks_at, double after_s = 0.0) {
  const Track track(TrackFilter({}, kStart,
                                {.p_ecef = site().to_ecef({0, 300, 50}),
                                 .v_ecef = site().R_ecef_enu() * Vector3d(50, 0, 0),
                                 .position_sd_m = 0.1,
                                 .velocity_sd_m_s = 0.1}));
  const BearingMeasurement measurement =
      measurement_of(ray_to("a", {0, 0, 0}, looks_at), kStart + std::llround(after_s * 1e6));
  const LineOfSight& sight = measurement.sight;
  return summarise_track(track).may_see(measurement, direction_ecef(sight), may_be_off_rad(sight));
}

TEST(TrackGlance, RulesOutWhatLooksElsewhere) {
  EXPECT_TRUE(may_see({0, 300, 50}));
  EXPECT_TRUE(may_see({3, 300, 50}));
  EXPECT_FALSE(may_see({30, 300, 50}));
  EXPECT_FALSE(may_see({0, -300, -50})) << "behind the camera";
}

TEST(TrackGlance, GoesOnWithTheTrack) {
  EXPECT_TRUE(may_see({50, 300, 50}, 1.0));
  EXPECT_FALSE(may_see({0, 300, 50}, 1.0));
}

}  // namespace
}  // namespace ols::fusion
