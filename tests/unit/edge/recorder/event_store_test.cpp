#include "edge/recorder/event_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/edge/recorder/temporary_folder.h"

namespace ols {
namespace {

using testing::ElementsAre;

constexpr double kAll = 1e18;  // more than a disk has

void make_event(const TemporaryFolder& store, const std::string& name, std::size_t bytes) {
  std::filesystem::create_directories(store / name);
  std::ofstream(store / (name + "/1.png")) << std::string(bytes, 'x');
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
  EventStore store(folder.path(), kAll, 0.0);
  store.survey();
  EXPECT_EQ(store.events(), 2U);
  EXPECT_EQ(store.bytes(), 1500.0);
  EXPECT_GT(store.free_bytes(), 0.0);
}

TEST(EventStore, MakesItsFolder) {
  const TemporaryFolder folder;
  EventStore store((folder / "a/b").string(), kAll, 0.0);
  store.survey();
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
}

TEST(EventStore, TheOldestGoUntilTheNewFits) {
  const TemporaryFolder folder;
  make_event(folder, kOld, 1000);
  make_event(folder, kMiddle, 1000);
  make_event(folder, kNew, 1000);
  make_event(folder, "holiday", 1000);
  EventStore store(folder.path(), 3000.0, 0.0);
  store.survey();
  store.make_room(0.0, {});
  EXPECT_EQ(store.removed(), 0U);
  store.make_room(1500.0, {});
  EXPECT_THAT(names_in(folder.path()), ElementsAre(kNew, "holiday"));
  EXPECT_EQ(store.removed(), 2U);
}

TEST(EventStore, NeverRemovesTheEventsThatAreWritten) {
  const TemporaryFolder folder;
  make_event(folder, kOld + ".partial", 1000);
  make_event(folder, kMiddle, 1000);
  make_event(folder, kNew + ".partial", 1000);
  EventStore store(folder.path(), 3000.0, 0.0);
  store.survey();
  store.make_room(1000.0, {kOld, kNew});
  EXPECT_THAT(names_in(folder.path()), ElementsAre(kOld + ".partial", kNew + ".partial"));
  EXPECT_THROW(store.make_room(1001.0, {kOld, kNew}), DiskFull);
  EXPECT_THAT(names_in(folder.path()), ElementsAre(kOld + ".partial", kNew + ".partial"));
  store.make_room(1001.0, {kNew});  // what an earlier run left behind goes
  EXPECT_THAT(names_in(folder.path()), ElementsAre(kNew + ".partial"));
}

TEST(EventStore, TheReserveIsNotTouched) {
  const TemporaryFolder folder;
  make_event(folder, kOld, 1000);
  EventStore store(folder.path(), kAll, kAll);
  store.survey();
  EXPECT_TRUE(store.full());
  EXPECT_THAT(store.full_text(), testing::MatchesRegex("disk full \\([0-9.]+ GB free\\)"));
  EXPECT_THROW(store.make_room(1.0, {}), DiskFull);
  EXPECT_THAT(names_in(folder.path()), ElementsAre(kOld));  // the disk is full of other things
}

TEST(EventStore, NamesAreFreeAndLabelled) {
  const TemporaryFolder folder;
  EventStore store(folder.path(), kAll, 0.0);
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
  EventStore store((folder / "file").string(), kAll, 0.0);
  EXPECT_THROW(store.survey(), std::system_error);
}

}  // namespace
}  // namespace ols
