#include "edge/recorder/event_store.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process/clocks.h"
#include "tests/unit/edge/recorder/recorder_files.h"

namespace ols::recorder {
namespace {

using testing::ElementsAre;

constexpr double kAll = 1e18;  // more than a disk has

void make_event(const TemporaryFolder& store, const std::string& name, std::size_t bytes) {
  std::filesystem::create_directories(store / name);
  std::ofstream(store / (name + "/1.png")) << std::string(bytes, 'x');
}

constexpr double kDay_s = 86400.0;
constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr std::int64_t kNow_us = 1'772'366'400'000'000;  // 1 March 2026, 12:00

// As if an event had last made room then.
void last_removal(const TemporaryFolder& store, std::int64_t utime_us) {
  const std::string path = store / ".removal";
  std::ofstream{path} << "x";
  const timespec at{static_cast<time_t>(utime_us / 1'000'000), 0};
  const timespec both[2] = {at, at};
  ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), both, 0), 0);
}

const std::string kOld = "20260101T000000.000Z_a", kMiddle = "20260101T000001.000Z_b",
                  kNew = "20260102T000000.000Z_c";

TEST(UtcName, SortsByTime) {
  EXPECT_EQ(utc_name(1'700'000'000'250'999), "20231114T221320.250Z");
  EXPECT_EQ(utc_name(0), "19700101T000000.000Z");
}

TEST(EventStore, CountsEventsAndNothingElse) {
  const TemporaryFolder folder;
  make_event(folder, kOld, 1000);
  make_event(folder, kNew + ".partial", 500);
  make_event(folder, "holiday", 10000);
  make_event(folder, "20260101T000000.000Zx", 10000);
  EventStore store({folder.path(), kAll, 0.0, kDay_s});
  store.survey();
  EXPECT_EQ(store.events(), 2U);
  EXPECT_EQ(store.bytes(), 1500.0);
  EXPECT_GT(store.free_bytes(), 0.0);
}

TEST(EventStore, MakesItsFolder) {
  const TemporaryFolder folder;
  EventStore store({folder / "a/b", kAll, 0.0, kDay_s});
  store.survey();
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
}

class EventRoom : public testing::Test {
 protected:
  EventStore surveyed(double quota_bytes) const {
    EventStore store({folder.path(), quota_bytes, 0.0, kDay_s});
    store.survey();
    return store;
  }
  std::set<std::string> names() const {
    auto found = names_in(folder.path());
    found.erase(".removal");
    return found;
  }

  const TemporaryFolder folder;
};

TEST_F(EventRoom, OneOldEventADayMakesRoom) {
  for (const auto& name : {kOld, kMiddle, kNew}) make_event(folder, name, 1000);
  make_event(folder, "holiday", 1000);
  last_removal(folder, kNow_us - 2 * kDay_us);
  EventStore store = surveyed(3000.0);
  store.make_room(0.0, {}, kNow_us);
  EXPECT_EQ(store.removed(), 0U);
  EXPECT_EQ(store.room_bytes({}, kNow_us), 1000.0);
  store.make_room(1000.0, {}, kNow_us);
  EXPECT_THAT(names(), ElementsAre(kMiddle, kNew, "holiday"));
  EXPECT_EQ(store.room_bytes({}, kNow_us), 1000.0) << "that of the one, not of a second";
  store.add("20260301T115959.000Z_x.partial", 1000.0);
  last_removal(folder, kNow_us);  // it was, by the test's clock
  EXPECT_EQ(store.room_bytes({}, kNow_us + kDay_us - 1'000'000), 0.0);
  EXPECT_THROW(store.make_room(1.0, {}, kNow_us + kDay_us - 1'000'000), DiskFull);
  EXPECT_THAT(names(), ElementsAre(kMiddle, kNew, "holiday"));
  store.make_room(1.0, {}, kNow_us + kDay_us);
  EXPECT_THAT(names(), ElementsAre(kNew, "holiday"));
  EXPECT_EQ(store.removed(), 2U);
}

// Any number of recordings, whatever they call themselves.
TEST_F(EventRoom, AFloodOfRecordingsCostsOneEventAtMost) {
  std::vector<std::string> evidence{kOld, kMiddle, kNew};
  for (const auto& name : evidence) make_event(folder, name, 1000);
  last_removal(folder, kNow_us - 2 * kDay_us);
  EventStore store = surveyed(6000.0);
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    const std::int64_t now_us = kNow_us + i * 100'000'000LL;  // for most of a day
    const std::string name = store.free_name(now_us, {'l', static_cast<char>('0' + i % 7)});
    try {
      store.make_room(1000.0, {}, now_us);
    } catch (const DiskFull&) {
      ++refused;
      continue;
    }
    make_event(folder, name, 1000);
    store.survey();
  }
  EXPECT_EQ(store.removed(), 1U);
  EXPECT_EQ(refused, 596);
  EXPECT_TRUE(names().contains(kMiddle) && names().contains(kNew));
}

TEST_F(EventRoom, TheLabelThatTakesMostRoomGivesWay) {
  make_event(folder, "20260101T000000.000Z_crash", 1000);
  for (int i = 1; i <= 5; ++i) {
    std::string name = "20260102T000000.000Z_test";
    name[14] = static_cast<char>('0' + i);
    make_event(folder, name, 300);
  }
  last_removal(folder, kNow_us - 2 * kDay_us);
  EventStore store = surveyed(2500.0);
  store.make_room(300.0, {}, kNow_us);
  EXPECT_TRUE(names().contains("20260101T000000.000Z_crash"));
  EXPECT_FALSE(names().contains("20260102T000001.000Z_test"));
}

TEST_F(EventRoom, WhatIsYoungerThanADayStays) {
  make_event(folder, "20260228T120001.000Z_a", 1000);
  last_removal(folder, kNow_us - 2 * kDay_us);
  EventStore store = surveyed(1500.0);
  EXPECT_THROW(store.make_room(1000.0, {}, kNow_us), DiskFull);
  EXPECT_EQ(store.removed(), 0U);
  store.make_room(1000.0, {}, kNow_us + 2'000'000);
  EXPECT_EQ(store.removed(), 1U);
}

// The time of the last removal is unknown: it counts as now.
TEST_F(EventRoom, AStoreWithoutThatMemoryKeepsEverythingForADay) {
  make_event(folder, kOld, 1000);
  EventStore store = surveyed(1500.0);
  EXPECT_THROW(store.make_room(1000.0, {}, clock_utime_us()), DiskFull);
  EXPECT_TRUE(names().contains(kOld));
  store.make_room(1000.0, {}, clock_utime_us() + kDay_us + 1'000'000);
  EXPECT_FALSE(names().contains(kOld));
}

TEST_F(EventRoom, NeverRemovesTheEventsThatAreWrittenNorOneForNothing) {
  make_event(folder, kOld + ".partial", 1000);
  make_event(folder, kMiddle, 1000);
  make_event(folder, kNew + ".partial", 1000);
  last_removal(folder, kNow_us - 2 * kDay_us);
  EventStore store = surveyed(3000.0);
  EXPECT_THROW(store.make_room(1001.0, {kOld, kNew}, kNow_us), DiskFull);
  EXPECT_TRUE(names().contains(kMiddle)) << "it would not have been enough";
  store.make_room(1000.0, {kOld, kNew}, kNow_us);
  EXPECT_THAT(names(), ElementsAre(kOld + ".partial", kNew + ".partial"));
  last_removal(folder, kNow_us - 2 * kDay_us);
  store.make_room(1500.0, {kNew}, kNow_us);  // what an earlier run left behind goes
  EXPECT_THAT(names(), ElementsAre(kNew + ".partial"));
}

TEST(EventStore, TheReserveIsNotTouched) {
  const TemporaryFolder folder;
  make_event(folder, kOld, 1000);
  EventStore store({folder.path(), kAll, kAll, kDay_s});
  store.survey();
  EXPECT_TRUE(store.full());
  EXPECT_THAT(store.full_text(), testing::MatchesRegex("disk full \\([0-9.]+ GB free\\)"));
  EXPECT_THROW(store.make_room(1.0, {}, kNow_us), DiskFull);
  EXPECT_THAT(names_in(folder.path()),
              ElementsAre(".removal", kOld));  // the disk is full of other things
}

TEST(EventStore, NamesAreFreeAndLabelled) {
  const TemporaryFolder folder;
  EventStore store({folder.path(), kAll, 0.0, kDay_s});
  const std::string name = store.free_name(0, "gust");
  EXPECT_EQ(name, "19700101T000000.000Z_gust");
  store.add(name + ".partial", 1.0);
  EXPECT_EQ(store.free_name(0, "gust"), "19700101T000000.000Z_gust_2");
  store.finished(name);
  EXPECT_EQ(store.free_name(0, "gust"), "19700101T000000.000Z_gust_2");
  EXPECT_EQ(store.free_name(0, ""), "19700101T000000.000Z_event");
}

TEST(EventStore, AFileInTheFoldersPlaceIsReported) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EventStore store({folder / "file", kAll, 0.0, kDay_s});
  EXPECT_THROW(store.survey(), std::system_error);
}

}  // namespace
}  // namespace ols::recorder
