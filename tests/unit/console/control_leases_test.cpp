#include "console/control_leases.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

TEST(ControlLeases, TheFirstToCommandHasControl) {
  ControlLeases desk(60.0);
  EXPECT_FALSE(desk.use("alfa", 1, "ana", 0.0));
  EXPECT_FALSE(desk.use("alfa", 1, "ana", 10.0));
  EXPECT_EQ(desk.use("alfa", 2, "ben", 10.5),
            "refused: ana has control for 60 s more; take over first");
  EXPECT_FALSE(desk.use("bravo", 2, "ben", 10.5));
}

TEST(ControlLeases, ItEndsWithTime) {
  ControlLeases desk(60.0);
  static_cast<void>(desk.use("alfa", 1, "ana", 0.0));
  EXPECT_FALSE(desk.use("alfa", 2, "ben", 60.0));
  EXPECT_TRUE(desk.use("alfa", 1, "ana", 61.0));
}

TEST(ControlLeases, ItCanBeTakenOverGivenUpAndLeft) {
  ControlLeases desk(60.0);
  static_cast<void>(desk.use("alfa", 1, "ana", 0.0));
  desk.take("alfa", 2, "ben", 1.0);
  EXPECT_TRUE(desk.use("alfa", 1, "ana", 2.0));
  desk.give_up("alfa", 1);  // not hers any more
  EXPECT_TRUE(desk.use("alfa", 1, "ana", 2.0));
  desk.leave(2);
  EXPECT_FALSE(desk.use("alfa", 1, "ana", 2.0));
}

TEST(ControlLeases, TellsEachChangeOfHolderOnce) {
  ControlLeases desk(60.0);
  static_cast<void>(desk.use("alfa", 1, "ana", 0.0));
  auto changes = desk.changes(0.0);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].second->name, "ana");
  static_cast<void>(desk.use("alfa", 1, "ana", 1.0));
  EXPECT_TRUE(desk.changes(1.0).empty());
  changes = desk.changes(61.5);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_FALSE(changes[0].second);
}

}  // namespace
}  // namespace ols::console
