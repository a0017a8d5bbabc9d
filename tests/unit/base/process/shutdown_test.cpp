#include "base/process/shutdown.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace ols {
namespace {

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

}  // namespace
}  // namespace ols
