#include "central/fusion/track_intake.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "central/tracking/live_tracks.h"
#include "dev/estimators/bearing_world.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

// Why the first station is quarantined, whose bearings are off by a degree after three seconds.
std::string quarantine_of_a_station_that_is_off(bool tracklets) {
  constexpr double kRightS = 3.0, kEndS = 12.0;
  const bench::WorldConfig world{.stations_enu = test::square(), .aims_enu = {}};
  std::mt19937_64 random(4);
  const bench::Path path = bench::cruising({{60, 60, 150}, {2.0, 0.0, 0.0}}, 1e-6, kEndS, random);
  LiveTracks tracks{TrackManagerConfig{}};
  PointingMonitor pointing;
  for (BearingMeasurement& m : bench::measure(world, {path}, kEndS, random)) {
    const bool is_off = m.station == "s0" &&
                        m.utime_us > bench::kStartUs + static_cast<std::int64_t>(kRightS * 1e6);
    if (is_off) {
      m.sight.direction.elevation_rad += radians(1.0);
      m.track_id = 77;
      m.is_tracklet = tracklets;
    }
    associate({&m, 1}, tracks, pointing);
    tracks.advance(m.utime_us);
  }
  return pointing.quarantine("s0");
}

TEST(TrackIntake, OnlyWhatWasDesignatedSpeaksAgainstAPose) {
  EXPECT_NE(quarantine_of_a_station_that_is_off(false), "");
  EXPECT_EQ(quarantine_of_a_station_that_is_off(true), "");
}

}  // namespace
}  // namespace ols::fusion
