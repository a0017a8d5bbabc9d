#include "edge/gpio/gpio_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/base/config/section_text.h"

namespace ols::gpio {
namespace {

const test::SectionText<GpioConfig> kSection{"gpio", gpio_section};

TEST(GpioConfig, IsEmptyWithoutKeys) {
  const GpioConfig config = kSection.read("");
  EXPECT_EQ(config.chip, "");
  EXPECT_EQ(config.stop_line, -1);
  EXPECT_FALSE(config.rearm_over_bus);
}

TEST(GpioConfig, ReadsEachKey) {
  const GpioConfig config = kSection.read(
      "chip = '/dev/gpiochip0'\nled_line = 22\nstop_line = 17\nstop_active_low = true\n"
      "stop_release_s = 0.1\ntrigger_line = 27\ntrigger_pulse_s = 0.002\nrearm_line = 18\n"
      "rearm_active_low = false\nrearm_hold_s = 2.5\nrearm = 'bus'\n");
  EXPECT_EQ(config.chip, "/dev/gpiochip0");
  EXPECT_EQ(config.led_line, 22);
  EXPECT_EQ(config.stop_line, 17);
  EXPECT_TRUE(config.stop_active_low);
  EXPECT_EQ(config.stop_release_s, 0.1);
  EXPECT_EQ(config.trigger_line, 27);
  EXPECT_EQ(config.trigger_pulse_s, 0.002);
  EXPECT_EQ(config.rearm_line, 18);
  EXPECT_FALSE(config.rearm_active_low);
  EXPECT_EQ(config.rearm_hold_s, 2.5);
  EXPECT_TRUE(config.rearm_over_bus);
}

TEST(GpioConfig, RefusesALineWithoutAChipAndALineUsedTwice) {
  EXPECT_THAT(kSection.error_of("chip = ''\nstop_line = 17\n"),
              testing::HasSubstr("stop_line: is given, but no chip"));
  EXPECT_THAT(kSection.error_of("chip = 'x'\nled_line = 17\nstop_line = 17\n"),
              testing::HasSubstr("stop_line: is used twice"));
  EXPECT_THAT(kSection.error_of("chip = 'x'\nrearm_line = 17\nstop_line = 17\n"),
              testing::HasSubstr("rearm_line: is used twice"));
}

}  // namespace
}  // namespace ols::gpio
