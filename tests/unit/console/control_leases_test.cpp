#include "console/control_leases.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

TEST(ControlLeases, TheFirstToCommandHasControl) {
  ControlLeases leases(60.0);
  EXPECT_TRUE(leases.use("alfa", 1, "ana", 0.0).empty());
  EXPECT_TRUE(leases.use("alfa", 1, "ana", 10.0).empty());
  EXPECT_EQ(leases.use("alfa", 2, "ben", 10.5),
            "refused: ana has control for 60 s more; take over first");
  EXPECT_TRUE(leases.use("bravo", 2, "ben", 10.5).empty());
}

TEST(ControlLeases, ItEndsWithTime) {
  ControlLeases leases(60.0);
  static_cast<void>(leases.use("alfa", 1, "ana", 0.0));
  EXPECT_TRUE(leases.use("alfa", 2, "ben", 60.0).empty());
  EXPECT_FALSE(leases.use("alfa", 1, "ana", 61.0).empty());
}

TEST(ControlLeases, ItCanBeTakenOverGivenUpAndLeft) {
  ControlLeases leases(60.0);
  static_cast<void>(leases.use("alfa", 1, "ana", 0.0));
  leases.take("alfa", 2, "ben", 1.0);
  EXPECT_FALSE(leases.use("alfa", 1, "ana", 2.0).empty());
  leases.give_up("alfa", 1);  // not hers any more
  EXPECT_FALSE(leases.use("alfa", 1, "ana", 2.0).empty());
  leases.leave(2);
  EXPECT_TRUE(leases.use("alfa", 1, "ana", 2.0).empty());
}

TEST(ControlLeases, TellsEachChangeOfHolderOnce) {
  ControlLeases leases(60.0);
  static_cast<void>(leases.use("alfa", 1, "ana", 0.0));
  auto changes = leases.changes(0.0);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].second->name, "ana");
  static_cast<void>(leases.use("alfa", 1, "ana", 1.0));
  EXPECT_TRUE(leases.changes(1.0).empty());
  changes = leases.changes(61.5);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_FALSE(changes[0].second);
}

}  // namespace
}  // namespace ols::console
