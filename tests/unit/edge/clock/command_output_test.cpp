#include "edge/clock/command_output.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>

namespace ols::clock {
namespace {

constexpr double kLong_s = 30.0;

TEST(CommandOutput, IsWhatTheProgramWrites) {
  EXPECT_EQ(command_output({"printf", "a\\nb"}, kLong_s), "a\nb");
}

TEST(CommandOutput, NothingFromAProgramThatIsNotThereOrFails) {
  EXPECT_EQ(command_output({"ols-no-such-program"}, kLong_s), std::nullopt);
  EXPECT_EQ(command_output({"sh", "-c", "echo x; exit 1"}, kLong_s), std::nullopt);
  EXPECT_EQ(command_output({}, kLong_s), std::nullopt);
}

TEST(CommandOutput, ErrorsAreNotOutput) {
  EXPECT_EQ(command_output({"sh", "-c", "echo x >&2; echo y"}, kLong_s), "y\n");
}

TEST(CommandOutput, AProgramThatHangsIsKilled) {
  EXPECT_EQ(command_output({"sleep", "1000"}, 0.05), std::nullopt);
  // Its output closed, but still there.
  EXPECT_EQ(command_output({"sh", "-c", "exec >&-; sleep 1000 2>&-"}, 0.05), std::nullopt);
}

TEST(CommandOutput, AProgramThatNeverStopsTalkingIsKilled) {
  EXPECT_EQ(command_output({"yes"}, kLong_s), std::nullopt);
}

TEST(CommandOutput, LeavesNoChildBehind) {
  command_output({"true"}, kLong_s);
  command_output({"sleep", "1000"}, 0.05);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace ols::clock
