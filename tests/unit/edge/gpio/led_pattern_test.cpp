#include "edge/gpio/led_pattern.h"

#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace ols::gpio
