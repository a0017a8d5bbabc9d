#include "console/alarm_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::console {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(AlarmChanges, BeginAndEnd) {
  const auto changes = alarm_changes({"camera: lost"}, {"ptu: homing"});
  EXPECT_THAT(changes.begun, ElementsAre("ptu: homing"));
  EXPECT_THAT(changes.ended, ElementsAre("camera: lost"));
}

TEST(AlarmChanges, ANumberThatGrowsIsNoNewAlarm) {
  const auto changes =
      alarm_changes({"camera: no frames for 3.5 s"}, {"camera: no frames for 14 s"});
  EXPECT_THAT(changes.begun, IsEmpty());
  EXPECT_THAT(changes.ended, IsEmpty());
}

}  // namespace
}  // namespace ols::console
