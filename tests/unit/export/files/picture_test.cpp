#include "export/files/picture.h"

#include <gtest/gtest.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

TEST(Picture, AnEndAddsNoPoint) {
  Picture picture;
  picture.take(made_target());
  Target end = made_target(7, kSecond_us);
  end.state = TrackState::kEnded;
  picture.take(end);
  const Track& track = picture.tracks().at(end.uid);
  EXPECT_EQ(track.points.size(), 1U);
  EXPECT_EQ(track.last.state, TrackState::kEnded);
}

TEST(Picture, ForgetsWhatIsOlderThanItsHistory) {
  Picture picture({.history_s = 10.0});
  for (int i = 0; i < 20; ++i) picture.take(made_target(7, i * kSecond_us));
  picture.take(made_line());
  picture.forget(kNow_us + 20 * kSecond_us);
  EXPECT_EQ(picture.tracks().begin()->second.points.size(), 10U);
  EXPECT_TRUE(picture.lines().empty());
  picture.forget(kNow_us + 40 * kSecond_us);
  EXPECT_TRUE(picture.is_empty());
}

TEST(Picture, WithoutAHistoryWhatIsLiveStays) {
  Picture picture({.history_s = 0.0});
  picture.take(made_target());
  picture.take(made_line());
  picture.forget(kNow_us + kSecond_us);
  EXPECT_EQ(picture.tracks().size(), 1U);
  EXPECT_EQ(picture.lines().size(), 1U);
}

TEST(Picture, AStationThatIsSilentForMinutesGoes) {
  Picture picture({.history_s = 10.0});
  picture.take(made_station());
  const std::int64_t then_us = picture.stations().begin()->second.utime_us;
  picture.forget(then_us + 200 * kSecond_us);
  EXPECT_EQ(picture.stations().size(), 1U);
  picture.forget(then_us + 301 * kSecond_us);
  EXPECT_TRUE(picture.stations().empty());
}

TEST(Picture, WhatHasNoHeightAboveTheSeaIsLeftOutWhereItIsNeeded) {
  Picture picture({.needs_sea = true});
  Target target = made_target();
  target.place.geoid_m = kUnknown;
  picture.take(target);
  EXPECT_TRUE(picture.is_empty());
  picture.take(made_target());
  EXPECT_EQ(picture.tracks().size(), 1U);
}

TEST(Picture, KeepsEveryPointOfItsHistoryWhileThereIsRoom) {
  Picture picture({.history_s = 60.0, .most_points = 2000});
  for (int i = 0; i < 600; ++i) {
    picture.take(made_target(7, i * kSecond_us / 10));
    picture.take(made_target(8, i * kSecond_us / 10));
  }
  for (const auto& [uid, track] : picture.tracks()) EXPECT_EQ(track.points.size(), 600U);
}

TEST(Picture, ManyTracksShareTheRoomAndKeepTheirNewestPoints) {
  constexpr int kTracks = 10;
  Picture picture({.history_s = 60.0, .most_points = 60 * kTracks});
  for (int i = 0; i < 600; ++i) {
    for (int id = 1; id <= kTracks; ++id) picture.take(made_target(id, i * kSecond_us / 10));
  }
  for (const auto& [uid, track] : picture.tracks()) {
    EXPECT_LE(track.points.size(), 62U);
    EXPECT_GE(track.points.size(), 50U);
    EXPECT_EQ(track.points.back().utime_us, kNow_us + 599 * kSecond_us / 10);
  }
}

TEST(Picture, ALineEndsWhereItPoints) {
  const Place end = end_of(made_line(), 10'000.0);  // east, 2 degrees up
  EXPECT_NEAR(end.latitude_deg, 47.4, 1e-4);
  // 10 km * cos(2 deg) on a parallel of 4 329 km radius.
  EXPECT_NEAR(end.longitude_deg - 13.2, 0.1323, 2e-4);
  // 349 m by the angle, 7.8 m by the Earth's curvature.
  EXPECT_NEAR(end.height_m, 601.0 + 349.0 + 7.8, 0.2);
}

}  // namespace
}  // namespace ols::exports
