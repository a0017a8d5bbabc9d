#include "console/replay/timeline.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

ReceivedStation alfa(const std::string& padding = "") {
  ReceivedStation heard;
  heard.id = "alfa";
  heard.fields = {{"state", "tracking"}, {"padding", padding}};
  return heard;
}

Now at(std::int64_t utime_us) { return {static_cast<double>(utime_us) * 1e-6, utime_us}; }

TEST(Timeline, FindsTheSnapshotBeforeAnInstant) {
  Console console(60.0);
  Timeline timeline;
  EXPECT_EQ(timeline.before(5), nullptr);
  for (std::int64_t s = 1; s <= 60; ++s) {
    console.receive(alfa(), at(s * kSecond_us));
    timeline.reach(s * kSecond_us, static_cast<std::uint64_t>(100 * s), console);
  }
  EXPECT_EQ(timeline.first_us(), kSecond_us);
  EXPECT_EQ(timeline.last_us(), 60 * kSecond_us);
  EXPECT_EQ(timeline.before(kSecond_us - 1), nullptr);
  const Snapshot* snapshot = timeline.before(33 * kSecond_us);
  ASSERT_NE(snapshot, nullptr);
  EXPECT_LE(snapshot->utime_us, 33 * kSecond_us);
  EXPECT_GT(snapshot->utime_us, 27 * kSecond_us);
  EXPECT_EQ(snapshot->offset, static_cast<std::uint64_t>(snapshot->utime_us / kSecond_us * 100));
}

TEST(Timeline, ItsSnapshotsStayWithinTheirBound) {
  Console console(60.0);
  Timeline timeline;
  for (std::int64_t s = 1; s <= 600; ++s) {
    console.receive(alfa(std::string(200'000, 'x')), at(s * kSecond_us));
    timeline.reach(s * kSecond_us, 0, console);
  }
  EXPECT_GT(timeline.snapshots(), 10U);
  EXPECT_LT(timeline.snapshots(), Timeline::kMostSnapshotBytes / 200'000);
  EXPECT_EQ(timeline.before(kSecond_us)->utime_us, kSecond_us) << "the first one stays";
}

TEST(Timeline, MarksEventsOnceAndWithTheirOutcome) {
  Console console(60.0);
  Timeline timeline;
  ReceivedStation station = alfa();
  station.alarms = alarms_of({"ptu: hot"});
  console.receive(station, at(kSecond_us));
  timeline.reach(kSecond_us, 0, console);
  console.receive(wire::Order{.station = "alfa", .kind = wire::Kind::kRelease, .id = {9, 1}},
                  at(2 * kSecond_us));
  static_cast<void>(console.turn(at(2 * kSecond_us)));
  timeline.reach(2 * kSecond_us, 0, console);
  console.receive(wire::Reply{.station = "alfa", .order = {9, 1}, .is_accepted = true});
  static_cast<void>(console.turn(at(3 * kSecond_us)));
  timeline.end(console);
  const Json marks = timeline.json().at("marks");
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].at("kind"), "alarm");
  EXPECT_EQ(marks[1].at("text"), "release");
  EXPECT_EQ(marks[1].at("outcome"), "done");
}

TEST(Timeline, ATargetsBirthAndEndAreEvents) {
  Timeline timeline;
  ReceivedTarget target{
      .what = ReceivedTarget::What::kPosition, .boot_id = 3, .id = "7", .fields = {}};
  timeline.receive(target, 1);
  timeline.receive(target, 2);
  target.what = ReceivedTarget::What::kDropped;
  timeline.receive(target, 3);
  timeline.receive(target, 4);
  const Json marks = timeline.json().at("marks");
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].at("kind"), "birth");
  EXPECT_EQ(marks[1].at("kind"), "end");
  EXPECT_EQ(marks[1].at("utime_us"), 3);
}

TEST(Timeline, WhatIsTooMuchIsCounted) {
  Timeline timeline;
  ReceivedTarget target{
      .what = ReceivedTarget::What::kPosition, .boot_id = 3, .id = "", .fields = {}};
  for (std::size_t i = 0; i < Timeline::kMostMarks + 10; ++i) {
    target.id = std::to_string(i);
    timeline.receive(target, static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(timeline.json().at("marks").size(), Timeline::kMostMarks);
  EXPECT_EQ(timeline.json().at("marks_left_out"), 10);
}

}  // namespace
}  // namespace ols::console
