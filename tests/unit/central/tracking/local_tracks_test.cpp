#include "central/tracking/local_tracks.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

BearingMeasurement named(std::int64_t track_id, std::int64_t utime_us) {
  BearingMeasurement measurement;
  measurement.station = std::string("a");
  measurement.track_id = track_id;
  measurement.utime_us = utime_us;
  return measurement;
}

TEST(LocalTracks, TheOneThatWasNotHeardOfForLongestGivesWay) {
  LocalTracks local;
  const auto most = static_cast<std::int64_t>(LocalTracks::kOfAStation);
  for (std::int64_t i = 1; i <= most; ++i) local.at(named(i, i)).id = 100 + i;
  local.at(named(1, 1000));  // heard again
  local.at(named(most + 1, 1001));
  EXPECT_EQ(local.size("a"), LocalTracks::kOfAStation);
  ASSERT_NE(local.find(named(1, 0)), nullptr);
  EXPECT_EQ(local.find(named(1, 0))->id, 101);
  EXPECT_EQ(local.find(named(2, 0)), nullptr);
}

TEST(LocalTracks, TwoIdentitiesBecomeOne) {
  LocalTracks local;
  local.at(named(1, 1)).id = 5;
  local.at(named(2, 1)).id = 9;
  local.rename(9, 5);
  EXPECT_EQ(local.find(named(2, 0))->id, 5);
  local.forget("a");
  EXPECT_EQ(local.find(named(1, 0)), nullptr);
}

}  // namespace
}  // namespace ols::fusion
