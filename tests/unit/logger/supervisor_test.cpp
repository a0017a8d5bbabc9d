// What can be judged without a bus; tests/e2e has the logger under a flood.
#include "tools/logger/supervisor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/temporary_folder.h"

namespace ols::logger {
namespace {

using testing::HasSubstr;

TEST(Supervisor, DoesNotStartOnAFullDiskAndSaysSo) {
  const TemporaryFolder folder;
  LoggerConfig config;
  config.folder = folder.path();
  config.disk_reserve_bytes = 1e18;
  Supervisor supervisor(config);
  for (int i = 0; i < 100; ++i) supervisor.turn(0.1 * i);
  const LoggerStatus status = supervisor.status();
  EXPECT_FALSE(status.recording);
  EXPECT_THAT(status.text, testing::MatchesRegex("disk full \\(.* GB free\\)"));
  EXPECT_EQ(status.starts, 0U);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Supervisor, TellsOfAFolderThatCannotBeWrittenOnce) {
  const TemporaryFolder folder;
  folder.put("logs", 1, 0);
  LoggerConfig config;
  config.folder = folder / "logs";
  Supervisor supervisor(config);
  for (int i = 0; i < 100; ++i) supervisor.turn(0.1 * i);
  EXPECT_THAT(supervisor.status().text, HasSubstr("logs"));
  EXPECT_EQ(supervisor.status().failures, 1U);
  EXPECT_EQ(supervisor.status().starts, 0U);
}

TEST(LoggerStatus, IsJson) {
  LoggerStatus status;
  status.text = "a \"quoted\"\nword\\";
  status.bytes = 1.5e9;
  EXPECT_EQ(to_json(status, 7),
            "{\"utime_us\":7,\"recording\":false,\"text\":\"a "
            "\\\"quoted\\\"?word\\\\\",\"bus_alarm\":\"\","
            "\"files\":0,\"bytes\":1500000000,\"disk_free_bytes\":0,\"starts\":0,\"failures\":0,"
            "\"files_removed\":0,\"files_lost\":0,\"messages_dropped\":0,"
            "\"bus_fragments_refused\":0,\"bus_datagrams_malformed\":0}");
}

}  // namespace
}  // namespace ols::logger
