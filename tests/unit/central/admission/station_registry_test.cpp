#include "central/admission/station_registry.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

TEST(StationRegistry, WhoIsNotNamedDoesNotBelong) {
  EXPECT_TRUE(StationRegistry({}, 4).belongs("anybody"));
  EXPECT_FALSE(StationRegistry({"a"}, 4).belongs("b"));
}

TEST(StationRegistry, AStationWithoutABearingGivesWayFirst) {
  MessageTime time;
  StationRegistry registry({}, 2);
  registry.for_bearing("works", time).station->bearings = 100;
  registry.for_status("idle", time);
  const auto place = registry.for_bearing("new", time);
  ASSERT_NE(place.station, nullptr);
  EXPECT_EQ(place.evicted, "idle");
  EXPECT_TRUE(registry.all().contains("works"));
}

TEST(StationRegistry, WhoWorksHereStays) {
  MessageTime time;
  StationRegistry registry({}, 2);
  for (const char* name : {"a", "b"}) {
    time.hear(name, kStart);
    registry.for_bearing(name, time).station->bearings = 100;
  }
  EXPECT_EQ(registry.for_bearing("stranger", time).station, nullptr);
  EXPECT_EQ(registry.for_status("stranger", time).station, nullptr);
  EXPECT_EQ(registry.all().size(), 2U);
}

TEST(StationRegistry, FollowsItsTargetForASecond) {
  KnownStation station;
  station.target_id = 3;
  station.saw_target.note(kStart);
  EXPECT_EQ(station.follows(kStart + 999'999), 3);
  EXPECT_EQ(station.follows(kStart + 1'000'000), 0);
}

}  // namespace
}  // namespace ols::fusion
