#include "central/fusion/target_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "tests/unit/central/given_tracks.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::confirm_at;
using test::GivenTracks;
using test::kStart;
using test::sight_of;

constexpr std::int64_t kFrameUs = 100'000;

Vector3d place(int k) { return {40.0 * k, 300.0, 50.0}; }

class TargetScheduleTest : public testing::Test {
 protected:
  // Tracks that have just been seen.
  void begin_tracks(int count) {
    for (int k = 0; k < count; ++k) now_us = confirm_at(tracks, place(k));
    ASSERT_EQ(std::ranges::count_if(tracks.tracks(), is_established), count);
  }
  // One bearing's outputs. All stations have sent theirs of `newest_us` or, by default, of "now".
  FusionOutput tell(TargetSchedule& schedule, std::optional<std::int64_t> newest_us = {}) {
    for (std::size_t k = 0; k < 4; ++k) {
      schedule.hear(sight_of(k, place(0), newest_us.value_or(now_us)), now_us);
    }
    FusionOutput output;
    schedule.tell(now_us, tracks, clocks, pointing, output, log);
    return output;
  }
  static std::vector<std::int64_t> ids(const std::vector<FusedTarget>& targets) {
    std::vector<std::int64_t> found;
    for (const FusedTarget& target : targets) found.push_back(target.target_id);
    return found;
  }

  GivenTracks tracks;
  ClockMonitor clocks;
  PointingMonitor pointing;
  FusionLog log;
  std::int64_t now_us = kStart;
};

using Ids = std::vector<std::int64_t>;

TEST_F(TargetScheduleTest, PublishesEachTargetOfAnEpochOnce) {
  begin_tracks(3);
  TargetSchedule schedule({.paper_targets = 0});
  EXPECT_FALSE(schedule.epoch_us());
  const FusionOutput output = tell(schedule);
  EXPECT_EQ(ids(output.targets), (Ids{1, 2, 3}));
  EXPECT_EQ(schedule.epoch_us(), now_us);
  for (int k = 0; k < 3; ++k) {
    const FusedTarget& target = output.targets[static_cast<std::size_t>(k)];
    EXPECT_EQ(target.utime_us, now_us);
    EXPECT_EQ(target.estimator, "filter");
    ASSERT_EQ(target.estimate.solution, Solution::kOk);
    EXPECT_LT((target.estimate.position_ecef - test::site().to_ecef(place(k))).norm(), 1.0);
  }
  EXPECT_TRUE(tell(schedule).targets.empty()) << "the same instant again";
  EXPECT_EQ(log.counters["targets"], 3.0);
  now_us += kFrameUs;
  EXPECT_EQ(ids(tell(schedule).targets), (Ids{1, 2, 3}));
}

TEST_F(TargetScheduleTest, ManyTargetsComeWithSeveralBearingsAndThePapersAfterThem) {
  begin_tracks(11);
  TargetSchedule schedule({.paper_targets = 3});
  const std::int64_t epoch_us = now_us;
  FusionOutput output = tell(schedule);
  EXPECT_EQ(ids(output.targets), (Ids{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(output.targets_paper.empty());
  now_us += 1000;
  output = tell(schedule);
  EXPECT_EQ(ids(output.targets), (Ids{9, 10, 11}));
  EXPECT_EQ(output.targets[0].utime_us, epoch_us) << "of the epoch, not of the bearing";
  EXPECT_EQ(ids(output.targets_paper), (Ids{1, 2})) << "each is worth four targets";
  EXPECT_EQ(output.targets_paper[0].estimator, "paper");
  now_us += 1000;
  output = tell(schedule);
  EXPECT_TRUE(output.targets.empty());
  EXPECT_EQ(ids(output.targets_paper), (Ids{3}));
}

TEST_F(TargetScheduleTest, APendingTargetWhoseTrackIsGoneIsLeftOut) {
  begin_tracks(10);
  TargetSchedule schedule({.paper_targets = 0});
  tell(schedule);
  tracks.clear_tracks();
  const FusionOutput output = tell(schedule);
  ASSERT_EQ(ids(output.targets), Ids{0}) << "that there is none";
  EXPECT_EQ(output.targets[0].estimate.solution, Solution::kTooFewRays);
}

TEST_F(TargetScheduleTest, WhatHasWaitedForTooLongIsDiscarded) {
  begin_tracks(11);
  TargetSchedule schedule({.paper_targets = 0, .give_up_s = 1.0});
  tell(schedule);
  now_us += 1'100'000;
  const FusionOutput output = tell(schedule);
  EXPECT_EQ(ids(output.targets), (Ids{1, 2, 3, 4, 5, 6, 7, 8})) << "an epoch of its own";
  EXPECT_EQ(output.targets[0].utime_us, now_us);
}

TEST_F(TargetScheduleTest, EpochsComeAtTheirRateAtMost) {
  begin_tracks(1);
  TargetSchedule schedule({.rate_hz = 10.0, .paper_targets = 0});
  int epochs = 0;
  for (int i = 0; i < 100; ++i, now_us += 10'000) {
    epochs += tell(schedule).targets.empty() ? 0 : 1;
  }
  EXPECT_GE(epochs, 9);
  EXPECT_LE(epochs, 12);
}

TEST_F(TargetScheduleTest, AnEstimatorWithoutMemoryIsAskedForNow) {
  begin_tracks(1);
  TargetSchedule schedule({.estimator = "least-squares", .paper_targets = 0});
  const FusionOutput output = tell(schedule, now_us + 50'000);
  ASSERT_EQ(output.targets.size(), 1U);
  EXPECT_EQ(output.targets[0].utime_us, now_us);
  EXPECT_EQ(output.targets[0].estimator, "least-squares");
}

TEST_F(TargetScheduleTest, WithoutAnyRayThereAreTooFew) {
  TargetSchedule schedule({});
  const FusionOutput output = tell(schedule);
  ASSERT_EQ(output.targets.size(), 1U);
  EXPECT_EQ(output.targets[0].target_id, 0);
  EXPECT_EQ(output.targets[0].estimate.solution, Solution::kTooFewRays);
  EXPECT_EQ(log.counters["targets_without_position"], 1.0);
}

TEST_F(TargetScheduleTest, AStationAloneGivesItsLineAndBesideTargetsOnlyIfItFollowsAnother) {
  const Vector3d other(-150.0, 250.0, 90.0);
  const auto look = [&](std::int64_t track_id) {
    for (int i = 0; i < 4; ++i) {
      BearingMeasurement measurement = sight_of(2, other, now_us - 20'000 * (3 - i));
      measurement.track_id = track_id;
      tracks.keep_unassociated(measurement);
    }
  };
  look(0);
  TargetSchedule alone({.paper_targets = 0});
  FusionOutput output = tell(alone);
  ASSERT_EQ(output.targets.size(), 1U);
  EXPECT_EQ(output.targets[0].estimate.solution, Solution::kBearingOnly);
  ASSERT_TRUE(output.targets[0].bearing_only);
  EXPECT_EQ(output.targets[0].bearing_only->station, "c");

  begin_tracks(1);
  look(0);
  TargetSchedule beside({.paper_targets = 0});
  EXPECT_EQ(ids(tell(beside).targets), Ids{1}) << "mere detections are no object";
  now_us += kFrameUs;
  look(7);
  output = tell(beside);
  ASSERT_EQ(output.targets.size(), 2U);
  EXPECT_EQ(output.targets[0].target_id, 1);
  ASSERT_TRUE(output.targets[1].bearing_only);
  EXPECT_EQ(output.targets[1].bearing_only->track_id, 7);
}

TEST_F(TargetScheduleTest, ClearedItBeginsAnyEpoch) {
  begin_tracks(1);
  TargetSchedule schedule({.paper_targets = 0});
  ASSERT_EQ(tell(schedule).targets.size(), 1U);
  schedule.clear();
  EXPECT_FALSE(schedule.epoch_us());
  EXPECT_EQ(tell(schedule).targets.size(), 1U) << "the same instant counts again";
}

}  // namespace
}  // namespace ols::fusion
