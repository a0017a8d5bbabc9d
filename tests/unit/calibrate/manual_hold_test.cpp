#include "tools/calibrate/manual_hold.h"

#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

using Status = ols_msg::station_status_t;

TEST(ManualHold, AReleaseBySomebodyElseEndsIt) {
  ManualHold hold;
  hold.hear(Status::STATE_IDLE);
  hold.point();
  hold.hear(Status::STATE_IDLE);  // said before the command arrived
  EXPECT_FALSE(hold.is_lost());
  hold.accept();
  hold.hear(Status::STATE_MANUAL);
  EXPECT_FALSE(hold.is_lost());
  for (const auto state : {Status::STATE_IDLE, Status::STATE_LOST, Status::STATE_SLEWED}) {
    hold.hear(state);
    EXPECT_TRUE(hold.is_lost()) << int{state};
  }
}

// Several messages can be handled at once: the last one alone does not tell.
TEST(ManualHold, TakenAgainByAnOperatorItStaysLost) {
  for (const auto between : {Status::STATE_IDLE, Status::STATE_STOPPED}) {
    ManualHold hold;
    hold.point();
    hold.accept();
    for (const auto state : {Status::STATE_MANUAL, between, Status::STATE_MANUAL}) hold.hear(state);
    EXPECT_TRUE(hold.is_lost()) << int{between};
  }
}

TEST(ManualHold, AnOperatorsOwnManualOperationBeforehandIsNone) {
  ManualHold hold;
  hold.hear(Status::STATE_MANUAL);
  hold.hear(Status::STATE_IDLE);
  EXPECT_FALSE(hold.is_lost());
}

}  // namespace
}  // namespace ols::calibration
