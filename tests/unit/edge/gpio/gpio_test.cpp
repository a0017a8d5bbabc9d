// The thread on a real socket with simulated lines behind it. Nothing is judged by how long it
// took.
#include "edge/gpio/gpio.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <mutex>
#include <vector>

#include "base/process/clocks.h"
#include "edge/gpio/gpio_lines.h"
#include "sim/gpio/gpio_socket.h"
#include "tests/unit/eventually.h"

namespace ols::gpio {
namespace {

using sim::GpioServer;
using sim::GpioServerConfig;
using testing::ElementsAre;
using testing::HasSubstr;

class GpioTest : public testing::Test {
 protected:
  GpioTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    server_config.path = (std::filesystem::temp_directory_path() /
                          ("ols_gpio_" + std::string(test->name()) + std::to_string(::getpid())))
                             .string();
    config.chip = "socket:" + server_config.path;
    config.stop_line = server_config.stop_line;
    config.rearm_line = server_config.rearm_line;
    config.rearm_hold_s = 0.3;
    config.led_line = server_config.led_line;
    config.trigger_line = server_config.trigger_line;
  }

  std::function<void(bool)> listener() {
    return [this](bool pressed) {
      const std::lock_guard lock(mutex);
      calls.push_back(pressed);
    };
  }
  std::vector<bool> heard() {
    const std::lock_guard lock(mutex);
    return calls;
  }
  bool hears(const std::vector<bool>& wanted) {
    return eventually([&] { return heard() == wanted; });
  }

  std::function<void()> rearms() {
    return [this] {
      const std::lock_guard lock(mutex);
      ++rearmed;
    };
  }
  int rearm_count() {
    const std::lock_guard lock(mutex);
    return rearmed;
  }

  GpioServerConfig server_config;
  GpioConfig config;
  std::mutex mutex;
  std::vector<bool> calls;
  int rearmed = 0;
};

TEST_F(GpioTest, TellsTheFirstLevelThenEveryEdge) {
  GpioServer server(server_config);
  const Gpio gpio(config, listener());
  ASSERT_TRUE(hears({false}));
  EXPECT_FALSE(gpio.stop_pressed());
  server.set_pressed(true);
  ASSERT_TRUE(hears({false, true}));
  EXPECT_TRUE(gpio.stop_pressed());
  EXPECT_THAT(gpio.report().alarms, ElementsAre("gpio: emergency stop pressed"));
  server.set_pressed(false);
  ASSERT_TRUE(hears({false, true, false}));
  EXPECT_THAT(gpio.report().alarms, ElementsAre());
  EXPECT_EQ(gpio.report().counters.at("gpio_stop_presses"), 1U);
}

TEST_F(GpioTest, APressThatIsOverAtOnceIsAPressAllTheSame) {
  GpioServer server(server_config);
  const Gpio gpio(config, listener());
  ASSERT_TRUE(hears({false}));
  server.set_pressed(true);
  server.set_pressed(false);
  ASSERT_TRUE(hears({false, true, false}));
}

TEST_F(GpioTest, AHeldButtonRearms) {
  GpioServer server(server_config);
  const Gpio gpio(config, listener(), rearms());
  ASSERT_TRUE(hears({false}));
  ASSERT_TRUE(eventually([&] {  // until it is seen open, and then held
    server.hold_rearm(false);
    const double end_s = clock_monotonic_s() + 0.2;
    if (!eventually([&] { return clock_monotonic_s() > end_s; })) return false;
    server.hold_rearm(true);
    return eventually([&] { return rearm_count() > 0; }, 5.0);
  }));
  EXPECT_EQ(gpio.report().counters.at("gpio_rearms"), 1U);
}

TEST_F(GpioTest, PressedFromTheStart) {
  GpioServer server(server_config);
  server.set_pressed(true);
  const Gpio gpio(config, listener());
  EXPECT_TRUE(gpio.stop_pressed());  // also before it is known
  ASSERT_TRUE(hears({true}));
}

TEST_F(GpioTest, TheOtherPolarity) {
  server_config.stop_active_low = config.stop_active_low = true;
  GpioServer server(server_config);
  const Gpio gpio(config, listener());
  ASSERT_TRUE(hears({false}));
  server.set_pressed(true);
  ASSERT_TRUE(hears({false, true}));
}

TEST_F(GpioTest, NobodyServesTheLines) {
  const Gpio gpio(config, listener());
  ASSERT_TRUE(hears({true}));
  EXPECT_TRUE(gpio.stop_pressed());
  const device::DeviceReport report = gpio.report();
  EXPECT_EQ(report.state, device::DeviceState::kAbsent);
  EXPECT_THAT(report.last_error, HasSubstr("cannot be connected"));
  ASSERT_EQ(report.alarms.size(), 1U);
  EXPECT_THAT(report.alarms[0], HasSubstr("gpio: stop unreadable, taken as pressed"));
}

TEST_F(GpioTest, LinesThatVanishArePressedAndAreOpenedAgain) {
  auto server = std::make_unique<GpioServer>(server_config);
  const Gpio gpio(config, listener());
  ASSERT_TRUE(hears({false}));
  server.reset();
  ASSERT_TRUE(hears({false, true}));
  EXPECT_TRUE(eventually([&] { return gpio.report().state == device::DeviceState::kAbsent; }));
  EXPECT_GE(gpio.report().counters.at("gpio_failures"), 1U);
  server = std::make_unique<GpioServer>(server_config);
  ASSERT_TRUE(hears({false, true, false}));
  EXPECT_EQ(gpio.report().state, device::DeviceState::kOk);
}

TEST_F(GpioTest, LinesThatNoLongerAnswerArePressed) {
  GpioServer server(server_config);
  const Gpio gpio(config, listener());
  ASSERT_TRUE(hears({false}));
  server.set_silent(true);
  ASSERT_TRUE(hears({false, true}));
  EXPECT_THAT(gpio.report().last_error, HasSubstr("does not answer"));
  server.set_silent(false);
  ASSERT_TRUE(hears({false, true, false}));
}

TEST_F(GpioTest, ShowsPatternsOnTheLed) {
  GpioServer server(server_config);
  Gpio gpio(config, listener());
  gpio.show(LedPattern::kTracking);
  ASSERT_TRUE(eventually([&] { return server.led(); }));
  gpio.show(LedPattern::kOff);
  ASSERT_TRUE(eventually([&] { return !server.led(); }));
  const auto before = server.led_changes();
  gpio.show(LedPattern::kTrouble);
  ASSERT_TRUE(eventually([&] { return server.led_changes() >= before + 6; }));
}

TEST_F(GpioTest, TheLedIsOffAtTheEnd) {
  GpioServer server(server_config);
  {
    Gpio gpio(config, listener());
    gpio.show(LedPattern::kTracking);
    ASSERT_TRUE(eventually([&] { return server.led(); }));
  }
  EXPECT_TRUE(eventually([&] { return !server.led(); }));
}

TEST_F(GpioTest, EachTriggerIsAPulse) {
  GpioServer server(server_config);
  Gpio gpio(config, listener());
  ASSERT_TRUE(hears({false}));
  for (std::uint64_t i = 1; i <= 3; ++i) {
    gpio.trigger();
    ASSERT_TRUE(eventually([&] { return server.triggers() == i; }));
  }
  EXPECT_EQ(gpio.report().counters.at("gpio_triggers"), 3U);
}

TEST_F(GpioTest, WithoutAStopLineNothingIsEverPressed) {
  config.stop_line = -1;
  const Gpio gpio(config, listener());
  ASSERT_TRUE(eventually([&] { return gpio.report().errors > 0; }));
  EXPECT_FALSE(gpio.stop_pressed());
  EXPECT_TRUE(heard().empty());
}

TEST_F(GpioTest, AChipThatIsNoneIsReported) {
  config.chip = "/dev/null";
  const Gpio gpio(config, listener());
  ASSERT_TRUE(hears({true}));
  EXPECT_THAT(gpio.report().last_error, HasSubstr("/dev/null: cannot be opened"));
}

}  // namespace
}  // namespace ols::gpio
