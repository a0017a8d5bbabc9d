#include "edge/gpio/line_use.h"

#include <gtest/gtest.h>

namespace ols::gpio {
namespace {

GpioConfig with_stop(bool active_low) {
  return {.chip = "/dev/gpiochip0", .stop_line = 17, .stop_active_low = active_low};
}

// A contact that closes to ground opens to a high level, and the reverse: a broken wire must read
// as the open contact, which is a stop.
TEST(LineUse, ABrokenStopWireReadsAsPressed) {
  EXPECT_EQ(stop_input_line(with_stop(false)).bias, LineBias::kPullUp);
  EXPECT_EQ(stop_input_line(with_stop(true)).bias, LineBias::kPullDown);
  EXPECT_EQ(stop_input_line(with_stop(true)).line, 17);
}

TEST(LineUse, ABrokenRearmWireReadsAsOpen) {
  GpioConfig config{.chip = "/dev/gpiochip0", .rearm_line = 27, .rearm_active_low = true};
  ASSERT_EQ(line_use(config).inputs.size(), 1U);
  EXPECT_EQ(line_use(config).inputs[0].bias, LineBias::kPullUp);
  config.rearm_active_low = false;
  EXPECT_EQ(line_use(config).inputs[0].bias, LineBias::kPullDown);
}

TEST(LineUse, OnlyLinesThatAreConfigured) {
  EXPECT_TRUE(line_use({.chip = "/dev/gpiochip0"}).inputs.empty());
  EXPECT_TRUE(line_use({.chip = "/dev/gpiochip0"}).outputs.empty());
  GpioConfig config = with_stop(false);
  config.led_line = 22;
  config.trigger_line = 23;
  EXPECT_EQ(line_use(config).inputs.size(), 1U);
  EXPECT_EQ(line_use(config).outputs, (std::vector{22, 23}));
}

}  // namespace
}  // namespace ols::gpio
