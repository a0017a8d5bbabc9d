#include "edge/gpio/gpio_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::gpio {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const GpioConfig kConfig{.chip = "/dev/gpiochip0", .stop_line = 17};

TEST(GpioReport, OfAStopThatIsReleased) {
  const device::DeviceReport report =
      make_gpio_report(kConfig, {.open = true, .readable = true, .pressed = false});
  EXPECT_EQ(report.state, device::DeviceState::kOk);
  EXPECT_EQ(report.text, "/dev/gpiochip0, stop released");
  EXPECT_THAT(report.alarms, IsEmpty());
}

TEST(GpioReport, APressedStopIsAnAlarm) {
  const device::DeviceReport report =
      make_gpio_report(kConfig, {.open = true, .readable = true, .pressed = true, .presses = 2});
  EXPECT_THAT(report.alarms, ElementsAre("gpio: emergency stop pressed"));
  EXPECT_EQ(report.counters.at("gpio_stop_presses"), 2U);
}

TEST(GpioReport, BeforeTheFirstLevelTheStopCountsAsPressed) {
  EXPECT_TRUE(stop_pressed(kConfig, {.open = true}));
  EXPECT_FALSE(stop_pressed(GpioConfig{}, {.open = true}));
  EXPECT_EQ(make_gpio_report(kConfig, {.open = true}).state, device::DeviceState::kStarting);
}

TEST(GpioReport, LinesThatAreGoneAreAnAlarm) {
  const device::DeviceReport report =
      make_gpio_report(kConfig, {.error = "unplugged", .failures = 1});
  EXPECT_EQ(report.state, device::DeviceState::kAbsent);
  EXPECT_THAT(report.alarms, ElementsAre("gpio: stop unreadable, taken as pressed: unplugged"));
}

}  // namespace
}  // namespace ols::gpio
