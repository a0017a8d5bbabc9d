#include <gtest/gtest.h>

#include <string>

#include "edge/gpio/led_pattern.h"
#include "edge/gpio/line_protocol.h"
#include "edge/gpio/rearm_input.h"
#include "edge/gpio/stop_input.h"

namespace ols::gpio {
namespace {

// `seconds` of a pattern, a character a slot.
std::string shown(LedPattern pattern, double seconds) {
  std::string slots;
  for (int i = 0; i * kLedSlot_s < seconds - 1e-9; ++i) {
    slots += led_lit(pattern, i * kLedSlot_s) ? '#' : '.';
  }
  return slots;
}

TEST(LedPattern, OffAndSteady) {
  EXPECT_EQ(shown(LedPattern::kOff, 1.0), "..........");
  EXPECT_EQ(shown(LedPattern::kTracking, 1.0), "##########");
}

TEST(LedPattern, StartingBlinksSlowlyAndEvenly) {
  EXPECT_EQ(shown(LedPattern::kStarting, 4.0), "##########..........##########..........");
}

TEST(LedPattern, ReadyFlashesShortlyEveryTwoSeconds) {
  EXPECT_EQ(shown(LedPattern::kReady, 4.0), "#...................#...................");
}

TEST(LedPattern, TroubleBlinksFast) { EXPECT_EQ(shown(LedPattern::kTrouble, 1.2), "##..##..##.."); }

TEST(LedPattern, EmergencyIsADoubleFlash) {
  EXPECT_EQ(shown(LedPattern::kEmergency, 2.0), "#.#.......#.#.......");
}

TEST(LedPattern, HoldsWithinASlotAndBeforeItsBeginning) {
  EXPECT_TRUE(led_lit(LedPattern::kReady, 0.099));
  EXPECT_FALSE(led_lit(LedPattern::kReady, 0.101));
  EXPECT_FALSE(led_lit(LedPattern::kReady, -0.05));  // the last slot of the period before
}

using Levels = std::vector<LineProtocol::Level>;

TEST(LineProtocol, GivesTheLevelsOfItsLines) {
  LineProtocol protocol({17, 18});
  EXPECT_EQ(protocol.receive("in 17 1\nin 3 0\nin 18 0\nin 1"), (Levels{{17, true}, {18, false}}));
  EXPECT_EQ(protocol.receive("7 0\n"), (Levels{{17, false}})) << "a line in two pieces";
  EXPECT_EQ(protocol.receive(""), Levels{});
}

TEST(LineProtocol, RefusesWhatIsNoLevel) {
  for (const char* bad : {"in 17 2\n", "in -1 1\n", "in 17\n", "out 17 1\n", "in 99999999999 1\n",
                          "\n", "in 17 1 \n"}) {
    EXPECT_EQ(LineProtocol({17}).receive(bad), std::nullopt) << bad;
  }
}

TEST(LineProtocol, ALineWithoutEndIsRefusedHoweverItComes) {
  const std::string endless = "in " + std::string(70, '0') + "17 1\n";
  EXPECT_EQ(LineProtocol({17}).receive(endless), std::nullopt);
  EXPECT_EQ(LineProtocol({17}).receive(endless.substr(0, 66)), std::nullopt);
}

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

TEST(StopInput, IsUnknownBeforeTheFirstLevel) {
  const StopInput input(0.05);
  EXPECT_EQ(input.pressed(100.0), std::nullopt);
  EXPECT_EQ(input.due_s(), std::nullopt);
}

TEST(StopInput, AFirstReleaseIsNoPressBeforeItIsStable) {
  StopInput input(0.05);
  input.level(false, 1.0);
  EXPECT_EQ(input.pressed(1.0), std::nullopt);
  EXPECT_EQ(input.pressed(1.049), std::nullopt);
  EXPECT_EQ(input.pressed(1.051), false);
}

TEST(StopInput, APressCountsAtOnce) {
  StopInput input(0.05);
  input.level(false, 1.0);
  input.level(true, 2.0);
  EXPECT_EQ(input.pressed(2.0), true);
  EXPECT_EQ(input.due_s(), std::nullopt);
}

TEST(StopInput, AReleaseCountsWhenItIsStable) {
  StopInput input(0.05);
  input.level(true, 1.0);
  input.level(false, 2.0);
  EXPECT_EQ(input.pressed(2.04), true);
  ASSERT_TRUE(input.due_s());
  EXPECT_DOUBLE_EQ(*input.due_s(), 2.05);
  EXPECT_EQ(input.pressed(2.051), false);
}

TEST(StopInput, BouncingStartsTheWaitAnew) {
  StopInput input(0.05);
  input.level(true, 1.0);
  input.level(false, 2.00);
  input.level(true, 2.01);
  input.level(false, 2.02);
  EXPECT_EQ(input.pressed(2.06), true);
  EXPECT_EQ(input.pressed(2.071), false);
}

TEST(StopInput, TheSameLevelAgainDoesNotStartTheWaitAnew) {
  StopInput input(0.05);
  input.level(true, 1.0);
  input.level(false, 2.00);
  input.level(false, 2.04);  // read again
  EXPECT_EQ(input.pressed(2.051), false);
}

TEST(StopInput, ALostLineIsPressedUntilAStableRelease) {
  StopInput input(0.05);
  input.level(false, 1.0);
  ASSERT_EQ(input.pressed(2.0), false);
  input.lost();
  EXPECT_EQ(input.pressed(2.0), true);
  EXPECT_EQ(input.pressed(1e6), true);
  input.level(false, 3.0);
  EXPECT_EQ(input.pressed(3.01), true);
  EXPECT_EQ(input.pressed(3.06), false);
}

}  // namespace
}  // namespace ols::gpio
