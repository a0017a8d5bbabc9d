#include "base/process/command_output.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>

namespace ols {
namespace {

constexpr double kPatience_s = 30.0;

TEST(CommandOutput, IsWhatTheProgramWrites) {
  EXPECT_EQ(command_output({"printf", "a\\nb"}, kPatience_s), "a\nb");
}

TEST(CommandOutput, NothingFromAProgramThatIsNotThereOrFails) {
  EXPECT_EQ(command_output({"ols-no-such-program"}, kPatience_s), std::nullopt);
  EXPECT_EQ(command_output({"sh", "-c", "echo x; exit 1"}, kPatience_s), std::nullopt);
  EXPECT_EQ(command_output({}, kPatience_s), std::nullopt);
}

TEST(CommandOutput, ErrorsAreNotOutput) {
  EXPECT_EQ(command_output({"sh", "-c", "echo x >&2; echo y"}, kPatience_s), "y\n");
}

TEST(CommandOutput, AProgramThatHangsIsKilled) {
  EXPECT_EQ(command_output({"sleep", "1000"}, 0.05), std::nullopt);
  // Its output closed, but still there.
  EXPECT_EQ(command_output({"sh", "-c", "exec >&-; sleep 1000 2>&-"}, 0.05), std::nullopt);
}

// It has ended, but what it has started may still write.
TEST(CommandOutput, IsNotCompleteWhileAnotherHoldsIt) {
  EXPECT_EQ(command_output({"sh", "-c", "sleep 5 & echo x"}, 0.5), std::nullopt);
}

TEST(CommandOutput, AProgramThatNeverStopsTalkingIsKilled) {
  EXPECT_EQ(command_output({"yes"}, kPatience_s), std::nullopt);
}

TEST(CommandOutput, LeavesNoChildBehind) {
  command_output({"true"}, kPatience_s);
  command_output({"sleep", "1000"}, 0.05);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace ols
