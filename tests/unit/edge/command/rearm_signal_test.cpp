#include "edge/command/rearm_signal.h"

#include <gtest/gtest.h>

#include <csignal>

namespace ols::station {
namespace {

TEST(RearmSignal, IsTakenOnce) {
  install_rearm_handler();
  EXPECT_FALSE(take_rearm_signal());
  ASSERT_EQ(std::raise(SIGUSR1), 0);
  EXPECT_TRUE(take_rearm_signal());
  EXPECT_FALSE(take_rearm_signal()) << "one signal re-arms once";
}

}  // namespace
}  // namespace ols::station
