#include "tools/logger/log_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <system_error>

#include "tests/unit/temporary_folder.h"
#include "tools/logger/log_names.h"

namespace ols::logger {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kUtime_us = 1'767'225'600'000'000;  // 2026-01-01

TEST(LogNames, AreOfTheirTimeAndNumbered) {
  const TemporaryFolder folder;
  LogNames names(folder.path(), "site");
  EXPECT_EQ(names.next(kUtime_us), folder / "site-20260101T000000Z.lcmlog.00");
  EXPECT_EQ(names.next(kUtime_us + 1), folder / "site-20260101T000000Z.lcmlog.01");
  EXPECT_EQ(names.next(kUtime_us + 1'000'000), folder / "site-20260101T000001Z.lcmlog.00");
}

TEST(LogNames, NoneIsTakenThatIsThere) {
  const TemporaryFolder folder;
  folder.put("site-20260101T000000Z.lcmlog.00", 1, 0);
  EXPECT_EQ(LogNames(folder.path(), "site").next(kUtime_us),
            folder / "site-20260101T000000Z.lcmlog.01");
}

const std::string kOld = "site-20260101T000000Z.lcmlog.00",
                  kMiddle = "site-20260101T000000Z.lcmlog.01",
                  kNew = "site-20260102T000000Z.lcmlog.00";

TEST(LogFolder, CountsItsLogsOldestFirst) {
  const TemporaryFolder folder;
  folder.put(kNew, 10, 3);
  folder.put(kOld, 20, 1);
  folder.put(kMiddle, 30, 2);
  folder.put("flight.lcmlog", 1000, 0);
  folder.put("other-20260101T000000Z.lcmlog.00", 1000, 0);
  LogFolder logs(folder.path(), "site");
  logs.survey();
  ASSERT_EQ(logs.files().size(), 3U);
  EXPECT_EQ(logs.files()[0].path, folder / kOld);
  EXPECT_EQ(logs.files()[2].path, folder / kNew);
  EXPECT_EQ(logs.bytes(), 60.0);
  EXPECT_GT(logs.free_bytes(), 0.0);
}

TEST(LogFolder, TheOldestGoFirstAndNoMoreThanMust) {
  const TemporaryFolder folder;
  folder.put(kOld, 100, 1);
  folder.put(kMiddle, 100, 2);
  folder.put(kNew, 100, 3);
  LogFolder logs(folder.path(), "site");
  logs.survey();
  logs.remove_oldest(400.0, 0.0, 100.0, "");
  EXPECT_EQ(logs.removed(), 0U);
  logs.remove_oldest(399.0, 0.0, 100.0, "");
  EXPECT_THAT(folder.names(), ElementsAre(kMiddle, kNew));
  EXPECT_EQ(logs.removed(), 1U);
  EXPECT_EQ(logs.bytes(), 200.0);
}

TEST(LogFolder, TheFileThatIsWrittenStaysEvenWhenItLooksOldestHoweverItsFolderIsSpelt) {
  for (const char* slash : {"", "/"}) {
    const TemporaryFolder folder;
    folder.put(kOld, 100, 1);
    folder.put(kMiddle, 100, 2);
    LogFolder logs(folder.path() + slash, "site");
    logs.survey();
    logs.remove_oldest(0.0, 0.0, 0.0, folder.path() + "/" + slash + kOld);
    EXPECT_THAT(folder.names(), ElementsAre(kOld)) << slash;
  }
}

TEST(LogFolder, TheOldestGoForTheDisksReserveToo) {
  const TemporaryFolder folder;
  folder.put(kOld, 100, 1);
  folder.put("flight.lcmlog", 100, 0);
  LogFolder logs(folder.path(), "site");
  logs.survey();
  logs.remove_oldest(1e18, 1e18, 0.0, "");
  EXPECT_THAT(folder.names(), ElementsAre("flight.lcmlog"));
}

TEST(LogFolder, MakesItsFolderAndNamesOneThatIsNone) {
  const TemporaryFolder folder;
  LogFolder(folder / "a/b", "site").survey();
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
  folder.put("file", 1, 0);
  EXPECT_THROW(LogFolder(folder / "file", "site").survey(), std::system_error);
}

}  // namespace
}  // namespace ols::logger
