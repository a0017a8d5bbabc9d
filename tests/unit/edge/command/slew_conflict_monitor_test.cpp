#include "edge/command/slew_conflict_monitor.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

TEST(SlewConflictMonitor, ARestartedFusionIsNoConflict) {
  SlewConflictMonitor senders;
  EXPECT_FALSE(senders.are_several(0.0));
  for (const std::int64_t boot_id : {1, 1, 2, 2, 3}) senders.note(boot_id, 1.0);
  EXPECT_FALSE(senders.are_several(1.0));
}

TEST(SlewConflictMonitor, ASenderThatComesBackIsASecondFusion) {
  SlewConflictMonitor senders;
  senders.note(1, 1.0);
  senders.note(2, 1.1);
  senders.note(1, 1.2);
  EXPECT_TRUE(senders.are_several(1.2));
  EXPECT_TRUE(senders.are_several(6.1));
  EXPECT_FALSE(senders.are_several(6.3)) << "one of them was stopped";
}

TEST(SlewConflictMonitor, ASenderIsForgottenAfterSomeSeconds) {
  SlewConflictMonitor senders;
  senders.note(1, 1.0);
  senders.note(2, 1.1);
  senders.note(1, 7.0);
  EXPECT_FALSE(senders.are_several(7.0)) << "one took over from the other, twice";
}

}  // namespace
}  // namespace ols::station
