#include "central/fusion/occlusion_schedule.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"
#include "tests/unit/central/ground/lands.h"

namespace ols::fusion {
namespace {

using test::flight;
using test::kStart;
using test::site;

// A wall stands before the west half of the view of a fifth station, which is south of the others.
// The target comes out of it due north after five seconds.
TEST(OcclusionSchedule, TellsAStationWhenAndWhereItsTargetComesOut) {
  constexpr double kOut_s = 5.0;
  Geodetic place = site().origin();
  const double level_m = place.height_m;
  place.height_m = 0.0;
  FusionConfig config;
  config.land.surface = std::make_shared<const Land>(
      [level_m](double east_m, double north_m) {
        const bool wall = east_m < 0.0 && std::abs(north_m + 900.0) < 5.0;
        return level_m + (wall ? 500.0 : 0.0);
      },
      1.0, place);
  Fusion fusion(config);
  fusion.know_station("lookout", {.camera_ecef = site().to_ecef({0.0, -1000.0, 2.0})});
  int told = 0;
  for (const BearingMeasurement& measurement : flight(8.0)) {
    for (const OcclusionNotice& notice : fusion.add(measurement).occlusions) {
      ASSERT_EQ(notice.station, "lookout");
      const double at_s = 1e-6 * static_cast<double>(notice.utime_us - kStart);
      if (notice.holds_s == 0.0) {  // withdrawn: it came out earlier than predicted
        EXPECT_GT(at_s, kOut_s);
        continue;
      }
      EXPECT_LT(at_s, kOut_s + 1.5);
      if (at_s < 1.5 || at_s > kOut_s - 0.5) continue;
      ++told;
      EXPECT_GT(notice.hidden, 0.5);
      ASSERT_TRUE(notice.exit);
      EXPECT_NEAR(at_s + notice.exit->in_s, kOut_s, 2.0 * notice.exit->sd_s);
      EXPECT_NEAR(wrap_pi(notice.exit->direction.azimuth_rad), 0.0, 0.02);
      EXPECT_GE(notice.holds_s, notice.exit->in_s);
    }
  }
  EXPECT_GT(told, 20);
}

// The same wall, which no model has: the station has seen it.
TEST(OcclusionSchedule, TellsAStationOfWhatOnlyItHasSeen) {
  Geodetic place = site().origin();
  const double level_m = place.height_m;
  place.height_m = 0.0;
  FusionConfig config;
  config.land.surface =
      std::make_shared<const Land>([level_m](double, double) { return level_m; }, 1.0, place);
  SkylineSector wall{.station = "lookout",
                     .begun_us = 1,
                     .camera_ecef = site().to_ecef({0.0, -1000.0, 2.0}),
                     .sector = 71};
  for (int column = 7100; column < 7200; ++column) {
    wall.columns.push_back({column, {0.5, 1e-4, 95.0, true}});
  }
  for (const bool is_seen : {false, true}) {
    Fusion fusion(config);
    if (is_seen) fusion.know_skyline(wall);  // of a station that is not known
    fusion.know_station("lookout", {.camera_ecef = wall.camera_ecef});
    int told = 0;
    for (const BearingMeasurement& measurement : flight(3.0)) {
      const auto notices = fusion.add(measurement).occlusions;
      told += static_cast<int>(notices.size());
      const double at_s = 1e-6 * static_cast<double>(measurement.utime_us - kStart);
      EXPECT_FALSE(at_s < 1.4 && told > 0);
      if (is_seen && at_s > 1.4) fusion.know_skyline(wall);
    }
    EXPECT_EQ(told > 5, is_seen);
  }
}

}  // namespace
}  // namespace ols::fusion
