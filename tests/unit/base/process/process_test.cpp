#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include "base/process/command_output.h"
#include "base/process/progress.h"
#include "base/process/shutdown.h"
#include "base/process/wakeup.h"

namespace ols {
namespace {

TEST(Progress, SaysHowFarLongWorkHasComeEveryFewSeconds) {
  std::ostringstream said;
  double now_s = 100.0;
  Progress progress("ols-track", "frames", said, [&now_s] { return now_s; });
  for (std::size_t frame = 0; frame < 90; ++frame, now_s += 0.125) progress(frame, 400);
  EXPECT_EQ(said.str(),
            "ols-track: 40 of 400 frames after 5 s\nols-track: 80 of 400 frames after 10 s\n");
  now_s += 10.0;
  said.str("");
  progress(7, 0);
  EXPECT_EQ(said.str(), "ols-track: 7 frames after 21 s\n");
}

// In a process of its own, because a request is never taken back.
void ask_to_end(int signal) {
  install_shutdown_handler();
  if (shutdown_requested()) std::exit(1);
  std::raise(signal);
  std::exit(shutdown_requested() ? 0 : 2);
}

TEST(ShutdownDeathTest, IsRequestedByEitherSignalAndEndsNothingItself) {
  EXPECT_EXIT(ask_to_end(SIGTERM), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(ask_to_end(SIGINT), testing::ExitedWithCode(0), "");
}

bool is_set(const Wakeup& wakeup) {
  pollfd entry{wakeup.descriptor(), POLLIN, 0};
  return ::poll(&entry, 1, 0) == 1;
}

TEST(Wakeup, StaysSetUntilCleared) {
  Wakeup wakeup;
  EXPECT_FALSE(is_set(wakeup));
  wakeup.set();
  wakeup.set();
  EXPECT_TRUE(is_set(wakeup));
  EXPECT_TRUE(is_set(wakeup));
  wakeup.clear();
  EXPECT_FALSE(is_set(wakeup));
  wakeup.clear();  // does not wait
}

TEST(Wakeup, ThrowsWithoutADescriptor) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_THROW(Wakeup{}, std::system_error);
  EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
}

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
