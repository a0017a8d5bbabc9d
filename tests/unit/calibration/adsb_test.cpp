#include "calibration/adsb.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols::calibration {
namespace {

std::vector<std::uint8_t> bytes(const std::string& hex) {
  std::vector<std::uint8_t> result;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    result.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return result;
}

// Reference frames of J. Sun, The 1090 Megahertz Riddle: an even and an odd position of one
// aircraft, 38000 ft; a velocity with a height difference of 550 ft of another.
const auto kEven = bytes("8D40621D58C382D690C8AC2863A7");
const auto kOdd = bytes("8D40621D58C386435CC412692AD6");
const auto kVelocity = bytes("8D485020994409940838175B284F");
constexpr std::int64_t kNow_us = 1'780'000'000'000'000;

// The velocity frame, as if the first aircraft had sent it: only its difference of heights counts.
std::vector<std::uint8_t> velocity_of_the_first() {
  auto message = kVelocity;
  std::copy(kEven.begin() + 1, kEven.begin() + 4, message.begin() + 1);
  // The parity of what was changed: tried out byte by byte.
  for (std::uint32_t parity = 0; parity < (1U << 24U); ++parity) {
    message[11] = static_cast<std::uint8_t>(parity >> 16U);
    message[12] = static_cast<std::uint8_t>(parity >> 8U);
    message[13] = static_cast<std::uint8_t>(parity);
    if (has_right_parity(message)) break;
  }
  return message;
}

TEST(Adsb, DecodesTheReferenceFrames) {
  AdsbDecoder decoder;
  EXPECT_FALSE(decoder.take(velocity_of_the_first(), kNow_us));
  EXPECT_FALSE(decoder.take(kOdd, kNow_us));
  const auto position = decoder.take(kEven, kNow_us + 1'000'000);
  ASSERT_TRUE(position);
  EXPECT_EQ(position->icao, "40621d");
  EXPECT_NEAR(position->latitude_deg, 52.2572021484375, 1e-9);
  EXPECT_NEAR(position->longitude_deg, 3.91937255859375, 1e-9);
  EXPECT_NEAR(position->height_m, (38000.0 + 550.0) * 0.3048, 0.01);
  EXPECT_EQ(position->utime_us, kNow_us + 1'000'000);
}

TEST(Adsb, ABarometricHeightAloneIsNoHeight) {
  AdsbDecoder decoder;
  decoder.take(kOdd, kNow_us);
  EXPECT_FALSE(decoder.take(kEven, kNow_us + 1'000'000));
  EXPECT_EQ(decoder.barometric_only(), 1);
}

TEST(Adsb, HalvesThatAreFarApartInTimeAreNoPosition) {
  AdsbDecoder decoder;
  decoder.take(velocity_of_the_first(), kNow_us);
  decoder.take(kOdd, kNow_us);
  EXPECT_FALSE(decoder.take(kEven, kNow_us + 11'000'000));
}

TEST(Adsb, ADamagedFrameIsNotBelieved) {
  EXPECT_TRUE(has_right_parity(kEven));
  for (std::size_t i = 0; i < kEven.size(); ++i) {
    auto damaged = kEven;
    damaged[i] ^= 0x10U;
    EXPECT_FALSE(has_right_parity(damaged)) << i;
  }
  EXPECT_FALSE(has_right_parity({}));
}

}  // namespace
}  // namespace ols::calibration
