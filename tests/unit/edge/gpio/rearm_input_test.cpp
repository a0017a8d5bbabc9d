#include "edge/gpio/rearm_input.h"

#include <gtest/gtest.h>

namespace ols::gpio {
namespace {

TEST(RearmInput, CountsOnceWhenItIsHeldForLongEnough) {
  RearmInput input(1.0);
  input.level(false, 1.0);
  input.level(true, 2.0);
  EXPECT_EQ(input.due_s(), 3.0);
  EXPECT_FALSE(input.take(2.99));
  EXPECT_TRUE(input.take(3.0));
  EXPECT_FALSE(input.take(10.0)) << "it is still held";
  input.level(true, 10.0);
  EXPECT_FALSE(input.take(20.0)) << "read again";
  input.level(false, 21.0);
  input.level(true, 22.0);
  EXPECT_TRUE(input.take(23.0)) << "and a second time";
}

TEST(RearmInput, TooShortIsNothing) {
  RearmInput input(1.0);
  for (int i = 0; i < 20; ++i) {
    input.level(false, i);
    input.level(true, i + 0.1);
    EXPECT_FALSE(input.take(i + 0.9)) << i;
  }
  input.level(false, 20.05);
  EXPECT_FALSE(input.take(100.0));
  EXPECT_EQ(input.due_s(), std::nullopt);
}

TEST(RearmInput, AButtonThatIsStuckAtTheStartIsNotHeld) {
  RearmInput input(1.0);
  input.level(true, 1.0);
  EXPECT_FALSE(input.take(100.0));
  EXPECT_EQ(input.due_s(), std::nullopt);
}

TEST(RearmInput, AfterAnInterruptionItMustBeSeenOpenFirst) {
  RearmInput input(1.0);
  input.level(false, 1.0);
  input.level(true, 2.0);
  input.interrupted();
  input.level(true, 2.5);
  EXPECT_FALSE(input.take(100.0));
  input.level(false, 101.0);
  input.level(true, 102.0);
  EXPECT_TRUE(input.take(103.0));
}

}  // namespace
}  // namespace ols::gpio
