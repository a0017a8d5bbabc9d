#include "tools/calibrate/motion_leave.h"

#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

using Status = ols_msg::station_status_t;

Status in(std::int8_t state) {
  Status status{};
  status.state = state;
  return status;
}

TEST(MotionLeave, AStopIsNeitherPointedAtNorReleased) {
  for (const auto state : {Status::STATE_STOPPED, Status::STATE_EMERGENCY}) {
    EXPECT_FALSE(may_point(in(state), 0.1));
    EXPECT_FALSE(may_release(in(state), 0.1));
  }
}

TEST(MotionLeave, OnlyManualOperationIsReleased) {
  EXPECT_TRUE(may_point(in(Status::STATE_IDLE), 0.1));
  EXPECT_FALSE(may_release(in(Status::STATE_IDLE), 0.1));
  EXPECT_TRUE(may_point(in(Status::STATE_MANUAL), 0.1));
  EXPECT_TRUE(may_release(in(Status::STATE_MANUAL), 0.1));
}

TEST(MotionLeave, WhatWasSaidBeforeTheHoldOfAStopSaysNothing) {
  for (const double age_s : {-1.0, 0.8, 1.0, 30.0}) {
    EXPECT_FALSE(may_point(in(Status::STATE_MANUAL), age_s)) << age_s;
    EXPECT_FALSE(may_release(in(Status::STATE_MANUAL), age_s)) << age_s;
  }
}

}  // namespace
}  // namespace ols::calibration
