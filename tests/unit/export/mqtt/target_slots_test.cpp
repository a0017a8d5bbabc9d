#include "export/mqtt/target_slots.h"

#include <gtest/gtest.h>

namespace ols::exports {
namespace {

TEST(TargetSlots, TheFirstFreeOneIsTaken) {
  TargetSlots slots(2);
  EXPECT_EQ(slots.take("a"), 0U);
  EXPECT_EQ(slots.take("b"), 1U);
  EXPECT_EQ(slots.take("a"), 0U);
  EXPECT_FALSE(slots.take("c"));
  EXPECT_EQ(slots.release("a"), 0U);
  EXPECT_TRUE(slots.is_free(0));
  EXPECT_FALSE(slots.release("a"));
  EXPECT_EQ(slots.take("c"), 0U);
}

}  // namespace
}  // namespace ols::exports
