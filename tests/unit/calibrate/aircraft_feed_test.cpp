#include "tools/calibrate/aircraft_feed.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols::calibration {
namespace {

// A frame whose counter has an escape in it, and a short one before it.
std::vector<std::uint8_t> stream() {
  std::vector<std::uint8_t> bytes{0x55, 0x1a, '2', 0, 0, 0, 0, 0, 1, 9, 1, 2, 3, 4, 5, 6, 7};
  const std::vector<std::uint8_t> frame{0x1a, '3', 0, 0, 0, 0, 0x1a, 0x1a, 7, 50};
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  for (std::uint8_t k = 0; k < 14; ++k) bytes.push_back(k);
  return bytes;
}

TEST(BeastFrames, FindsAFrameInPiecesOfAnySize) {
  for (const std::size_t piece : {1U, 3U, 100U}) {
    BeastFrames frames;
    std::vector<BeastFrames::Frame> found;
    const auto bytes = stream();
    for (std::size_t i = 0; i < bytes.size(); i += piece) {
      const std::size_t count = std::min(piece, bytes.size() - i);
      for (auto& frame : frames.take({bytes.data() + i, count})) found.push_back(frame);
    }
    ASSERT_EQ(found.size(), 1U) << piece;
    EXPECT_EQ(found[0].ticks, 0x1a07U);
    ASSERT_EQ(found[0].message.size(), 14U);
    EXPECT_EQ(found[0].message[13], 13);
  }
}

TEST(SbsPosition, ReadsALineWithAPosition) {
  const std::string line =
      "MSG,3,1,1,4CA2D6,1,2026/05/28,20:26:40.500,2026/05/28,20:26:40.600,,33000,,,49.5,16.25,,,"
      "0,0,0,0";
  const auto position = sbs_position(line);
  ASSERT_TRUE(position);
  EXPECT_EQ(position->icao, "4ca2d6");
  EXPECT_EQ(position->utime_us, 1'780'000'000'500'000);
  EXPECT_NEAR(position->height_m, 33000 * 0.3048, 1e-6);
  EXPECT_DOUBLE_EQ(position->longitude_deg, 16.25);
}

TEST(SbsPosition, ALineWithoutOneHasNone) {
  for (const char* line :
       {"", "MSG,3", "AIR,3,1,1,4CA2D6,1,2026/05/28,20:26:40.500,,,,33000,,,49.5,16.25",
        "MSG,3,1,1,4CA2D6,1,2026/13/28,20:26:40.500,,,,33000,,,49.5,16.25",
        "MSG,3,1,1,4CA2D6,1,2026/05/28,20:26:40.500,,,,,,,49.5,16.25",
        "MSG,3,1,1,4CA2,1,2026/05/28,20:26:40.500,,,,33000,,,49.5,16.25",
        "MSG,3,1,1,4CA2D6,1,2026/05/28,20:26:40.500,,,,33000,,,149.5,16.25"}) {
    EXPECT_FALSE(sbs_position(line)) << line;
  }
}

TEST(AircraftJson, TakesTheTimeAtWhichThePositionWasSeen) {
  const AircraftSnapshot snapshot = aircraft_json(R"({"now": 1780000010.5, "aircraft": [
      {"hex": "4ca2d6", "lat": 49.5, "lon": 16.25, "alt_geom": 33000, "seen_pos": 2.5},
      {"hex": "4ca2d7", "lat": 49.5, "lon": 16.25, "alt_baro": 33000, "seen_pos": 0.1},
      {"hex": "a,b", "lat": 49.5, "lon": 16.25, "alt_geom": 33000, "seen_pos": 0.1},
      {"hex": "4ca2d8"}]})");
  ASSERT_EQ(snapshot.positions.size(), 1U);
  EXPECT_EQ(snapshot.utime_us, 1'780'000'010'500'000);
  EXPECT_EQ(snapshot.positions[0].utime_us, 1'780'000'008'000'000);
  EXPECT_EQ(snapshot.barometric_only, 1);
}

TEST(AircraftJson, RefusesAnotherFile) {
  for (const char* text : {"", "[]", R"({"now": "x", "aircraft": []})", R"({"now": 1e300,
       "aircraft": []})",
                           R"({"now": 1.0, "aircraft": [{"lat": [], "lon": 1, "seen_pos": 1,
       "alt_geom": 1}]})"}) {
    EXPECT_THROW(aircraft_json(text), std::runtime_error) << text;
  }
}

// Nothing is heard for eight seconds after the connection; then frames come, late by their way.
TEST(TickClock, TheFirstFrameIsAsOldAsTheLeastDelaySays) {
  constexpr std::uint64_t kTicks_s = 12'000'000;
  constexpr std::int64_t kConnected_us = 1'780'000'000'000'000,
                         kHeard_us = kConnected_us + 8'000'000;
  TickClock clock;
  EXPECT_EQ(clock.take(5 * kTicks_s, kHeard_us + 90'000), 0);
  EXPECT_EQ(clock.first_utime_us(), kHeard_us + 90'000);
  EXPECT_EQ(clock.take(6 * kTicks_s, kHeard_us + 1'000'000 + 3'000), 1'000'000);
  EXPECT_EQ(clock.take(7 * kTicks_s, kHeard_us + 2'000'000 + 40'000), 2'000'000);
  EXPECT_EQ(clock.first_utime_us(), kHeard_us + 3'000);
}

// Messages wait on their way, some of them long: the clock shows in the one that waited least.
TEST(ReceiverDelay, IsThatOfTheMessageThatHardlyWaited) {
  constexpr std::int64_t kStamp_us = 1'780'000'000'000'000, kSlow_us = 2'500'000;
  ReceiverDelay delay;
  EXPECT_FALSE(delay.least_us());
  for (const std::int64_t waited_us : {900'000, 20'000, 4'000'000}) {
    delay.note(kStamp_us - kSlow_us, kStamp_us + waited_us);
  }
  EXPECT_EQ(delay.least_us(), kSlow_us + 20'000);
}

}  // namespace
}  // namespace ols::calibration
