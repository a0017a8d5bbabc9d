// With programs of the test's own in lcm-logger's place; tests/e2e has the real one.
#include "tools/logger/child_logger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <cerrno>

#include "tests/unit/eventually.h"

namespace ols {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::string end_of(ChildLogger& child) {
  std::optional<std::string> why;
  EXPECT_TRUE(eventually([&] { return (why = child.ended()).has_value(); }));
  return why.value_or("");
}

TEST(LoggerCommand, HasTheOptionsThatLcmLoggerTakes) {
  LoggerConfig config;
  config.folder = "/logs/100%";
  config.channels = "OLS_.*";
  config.split_bytes = 1048576.0 / 2;
  config.invert = true;
  const auto command = logger_command(config);
  EXPECT_EQ(command.front(), "lcm-logger");
  EXPECT_THAT(command, Contains("-i"));
  EXPECT_THAT(command, Contains("-s"));
  EXPECT_THAT(command, Contains("--split-mb=0.5"));
  EXPECT_THAT(command, Contains("--channel=OLS_.*"));
  EXPECT_THAT(command, Contains("--invert-channels"));
  EXPECT_THAT(command, Contains("--lcm-url=" + config.lcm_url));
  EXPECT_EQ(command.back(), "/logs/100%%/site-%Y%m%dT%H%M%SZ.lcmlog");
}

TEST(ChildLogger, HearsFileLossesAndTroubleButNoSummary) {
  ChildLogger child({"sh", "-c",
                     "echo 'Opening log file \"/l/site-1.lcmlog.00\"' >&2; echo 'Summary: x';"
                     "echo \"Can't write to log fast enough.  Dropped 12 packets\"; echo trouble"});
  std::vector<std::string> lines;
  EXPECT_TRUE(eventually([&] {
    for (const auto& line : child.listen()) lines.push_back(line);
    return lines.size() == 2;
  }));
  EXPECT_THAT(lines, ElementsAre(HasSubstr("Dropped 12"), "trouble"));
  EXPECT_EQ(child.current_file(), "/l/site-1.lcmlog.00");
  EXPECT_EQ(child.dropped(), 12U);
  EXPECT_EQ(end_of(child), "lcm-logger ended with status 0");
}

TEST(ChildLogger, SaysHowItEnded) {
  ChildLogger failed({"sh", "-c", "exit 3"});
  EXPECT_EQ(end_of(failed), "lcm-logger ended with status 3");
  ChildLogger missing({"ols-no-such-program"});
  EXPECT_THAT(end_of(missing), HasSubstr("is it installed?"));
  ChildLogger killed({"sleep", "1000"});
  EXPECT_FALSE(killed.ended());
  ::kill(killed.pid(), SIGKILL);
  EXPECT_EQ(end_of(killed), "lcm-logger was ended by signal 9");
}

TEST(ChildLogger, IsStoppedAndReapedAtTheEnd) {
  { const ChildLogger child({"sleep", "1000"}); }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(ChildLogger, IsMadeToEndWhenItDoesNotListen) {
  ChildLogger child({"sh", "-c", "trap '' TERM; echo deaf; while :; do sleep 0.05; done"});
  EXPECT_TRUE(eventually([&] { return !child.listen().empty(); }));
  child.stop();
  EXPECT_EQ(child.ended(), "lcm-logger was ended by signal 9");
}

}  // namespace
}  // namespace ols
