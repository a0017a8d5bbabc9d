// libgpiod's backend on a chip that is stood in for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <functional>
#include <memory>
#include <string>
#include <system_error>

#include "base/process/clocks.h"
#include "edge/gpio/gpio_lines.h"
#include "tests/unit/edge/gpio/fake_gpiod.h"
#include "tests/unit/error_text.h"

namespace ols::gpio {
namespace {

using testing::HasSubstr;

constexpr int kStop = 17, kRearm = 18, kLed = 22;

class ChipLines : public testing::Test {
 protected:
  ChipLines() {
    fake::chip() = {};
    use.inputs = {{kStop}};
    use.outputs = {kLed};
  }
  std::unique_ptr<GpioLines> open() { return open_chip_lines(fake::chip().path, use); }
  std::string error_of(const std::function<void()>& action) {
    return error_text<std::system_error>([&] { action(); }, "none");
  }
  static bool readable(int fd) {
    pollfd entry{fd, POLLIN, 0};
    return ::poll(&entry, 1, 0) == 1;
  }

  LineUse use;
};

TEST_F(ChipLines, RequestsWhatIsUsedAndGivesItBack) {
  {
    const auto lines = open();
    ASSERT_EQ(fake::chip().requested.size(), 2U);
    EXPECT_TRUE(fake::chip().requested.at(kLed).output);
    EXPECT_EQ(fake::chip().requested.at(kLed).value, 0);
    EXPECT_EQ(fake::chip().requested.at(kStop).flags, GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP);
  }
  EXPECT_EQ(fake::chip().open, 0);
  use.inputs[0].bias = LineBias::kPullDown;
  const auto lines = open();
  EXPECT_EQ(fake::chip().requested.at(kStop).flags, GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN);
}

TEST_F(ChipLines, BringsEdgesWithTheirTimesInOrder) {
  const auto lines = open();
  EXPECT_TRUE(lines->receive().empty());  // and does not wait
  EXPECT_FALSE(readable(lines->fds().at(0)));
  fake::chip().change(kStop, 1, 100.25);
  fake::chip().change(kStop, 0, 100.5);
  EXPECT_TRUE(readable(lines->fds().at(0)));
  const auto levels = lines->receive();
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_TRUE(levels[0].high);
  EXPECT_NEAR(levels[0].time_s, 100.25, 1e-6);
  EXPECT_FALSE(levels[1].high);
  EXPECT_NEAR(levels[1].time_s, 100.5, 1e-6);
}

TEST_F(ChipLines, ARefreshFindsALostEdgeAndKeepsTheOrder) {
  const auto lines = open();
  fake::chip().change_unnoticed(kStop, 1);
  const double before_s = clock_monotonic_s();
  lines->refresh();
  auto levels = lines->receive();
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_TRUE(levels[0].high);
  EXPECT_GE(levels[0].time_s, before_s);
  fake::chip().change(kStop, 0, 100.0);
  lines->refresh();
  levels = lines->receive();
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0].time_s, 100.0);
  EXPECT_FALSE(levels[1].high);
}

TEST_F(ChipLines, EachInputHasEdgesAndABiasOfItsOwn) {
  use.inputs = {{kStop, LineBias::kPullDown}, {kRearm, LineBias::kPullUp}};
  const auto lines = open();
  EXPECT_EQ(fake::chip().requested.at(kStop).flags, GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN);
  EXPECT_EQ(fake::chip().requested.at(kRearm).flags, GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP);
  fake::chip().change(kRearm, 1, 100.0);
  ASSERT_EQ(lines->fds().size(), 2U);
  EXPECT_FALSE(readable(lines->fds()[0]));
  EXPECT_TRUE(readable(lines->fds()[1]));
  auto levels = lines->receive();
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_TRUE(levels[0].line == kRearm && levels[0].high);
  lines->refresh();
  levels = lines->receive();
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_TRUE(levels[0].line == kStop && !levels[0].high);
  EXPECT_TRUE(levels[1].line == kRearm && levels[1].high);
}

TEST_F(ChipLines, ManyEdgesAtOnce) {
  const auto lines = open();
  for (int i = 0; i < 100; ++i) fake::chip().change(kStop, i % 2, i);
  EXPECT_EQ(lines->receive().size(), 100U);
}

TEST_F(ChipLines, WritesOutputs) {
  const auto lines = open();
  lines->write(kLed, true);
  EXPECT_EQ(fake::chip().requested.at(kLed).value, 1);
  lines->write(kLed, false);
  EXPECT_EQ(fake::chip().requested.at(kLed).value, 0);
}

TEST_F(ChipLines, WithoutAnInputThereIsNothingToWaitFor) {
  use.inputs.clear();
  const auto lines = open();
  EXPECT_TRUE(lines->fds().empty());
  lines->refresh();
  EXPECT_TRUE(lines->receive().empty());
}

TEST_F(ChipLines, SaysWhatIsWrong) {
  EXPECT_THAT(error_of([] { open_chip_lines("/dev/none", {}); }),
              HasSubstr("/dev/none: cannot be"));
  use.outputs = {99};
  EXPECT_THAT(error_of([this] { open(); }), HasSubstr("/dev/gpiochip9: has no line 99"));
  use.outputs = {kLed};
  fake::chip().refuses = true;
  EXPECT_THAT(error_of([this] { open(); }), HasSubstr("line 22 cannot be used as an output"));
  use.outputs = {};
  EXPECT_THAT(error_of([this] { open(); }), HasSubstr("line 17 cannot be watched"));
  EXPECT_EQ(fake::chip().open, 0);
}

TEST_F(ChipLines, AChipThatVanishes) {
  const auto lines = open();
  fake::chip().gone = true;
  EXPECT_THAT(error_of([&] { lines->receive(); }), HasSubstr("has vanished"));
  EXPECT_THAT(error_of([&] { lines->refresh(); }), HasSubstr("cannot be read"));
  EXPECT_THAT(error_of([&] { lines->write(kLed, true); }), HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace ols::gpio
