#include "tools/logger/log_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <system_error>

#include "tests/unit/temporary_folder.h"

namespace ols::logger {
namespace {

TEST(LogWriter, WritesWhatLcmReads) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.lcmlog";
  {
    LogWriter writer(path);
    writer.write({"OLS_A", {1, 0, 2}, 17});
    writer.write({"OLS_B", {}, 18});
    writer.flush();
    EXPECT_EQ(writer.bytes(), std::filesystem::file_size(path));
  }
  lcm::LogFile log(path, "r");
  const lcm::LogEvent* event = log.readNextEvent();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->channel, "OLS_A");
  EXPECT_EQ(event->timestamp, 17);
  ASSERT_EQ(event->datalen, 3);
  EXPECT_EQ(static_cast<const char*>(event->data)[2], 2);
  event = log.readNextEvent();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->channel, "OLS_B");
  EXPECT_EQ(event->datalen, 0);
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST(LogWriter, OverwritesNothing) {
  const TemporaryFolder folder;
  folder.put("a.lcmlog", 5, 0);
  EXPECT_THROW(LogWriter(folder / "a.lcmlog"), std::system_error);
  std::filesystem::create_symlink("nowhere", folder / "b.lcmlog");
  EXPECT_THROW(LogWriter(folder / "b.lcmlog"), std::system_error);
  EXPECT_EQ(std::filesystem::file_size(folder / "a.lcmlog"), 5U);
}

TEST(LogWriter, NoticesThatItsFileWasTakenAway) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.lcmlog";
  const LogWriter writer(path);
  EXPECT_TRUE(writer.is_in_place());
  std::filesystem::rename(path, folder / "b.lcmlog");
  EXPECT_FALSE(writer.is_in_place());
  folder.put("a.lcmlog", 0, 0);  // another one of the same name
  EXPECT_FALSE(writer.is_in_place());
}

}  // namespace
}  // namespace ols::logger
