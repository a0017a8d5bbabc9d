#include "export/asterix/categories.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

// tests/e2e/test_export_asterix.py has others' decoders read every field; here is what they depend
// on.
std::string hex(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    text += "0123456789abcdef"[static_cast<unsigned char>(c) >> 4U];
    text += "0123456789abcdef"[static_cast<unsigned char>(c) & 0xfU];
  }
  return text;
}

const AsterixSettings kSettings{.sac = 25, .sic = 10, .stations = {"alfa"}};

TEST(AsterixCategories, ASystemTrack) {
  // 47.5 and 13.25 degrees are 8854642 and 2469979 units; 22:13:20.123 are 10240015 / 128 s.
  EXPECT_EQ(hex(cat062(made_target(), 7, kSettings)),
            "3e0029"
            "9b0d1504"
            "190a"
            "9c400f"
            "00871c72"
            "0025b05b"
            "000c0010"
            "0007"
            "2c"
            "0034"
            "ffd1"
            "d4"
            "00040006"
            "0002"
            "03"
            "0202");
}

TEST(AsterixCategories, AccuraciesAreNeverBetterThanTheyAre) {
  Target target = made_target();
  target.covariance_m2 = {0.0025, 0.0, 0.0, 0.36, 0.0, 1e-8};
  target.velocity_covariance_m2_s2 = {1e-4, 0.0, 0.0, 0.0676, 0.0, 0.0};
  const std::string bytes = hex(cat062(target, 7, kSettings));
  // 0.05 and 0.6 m in units of 0.5 m, no covariance, a height's in 1.9 m, 0.01 and 0.26 m/s in
  // 0.25.
  EXPECT_EQ(bytes.substr(bytes.size() - 18),
            "00010002"
            "0000"
            "01"
            "0102");
}

TEST(AsterixCategories, StatesOfATrack) {
  Target target = made_target();
  const auto status = [&target](TrackState state) {
    target.state = state;
    return hex(cat062(target, 7, kSettings)).substr(2 * (3 + 4 + 2 + 3 + 8 + 4 + 2), 8);
  };
  EXPECT_EQ(status(TrackState::kTentative).substr(0, 2), "2e");
  EXPECT_EQ(status(TrackState::kEnded).substr(0, 4), "2d40");
  EXPECT_EQ(status(TrackState::kCoasted), "2d010180");
}

TEST(AsterixCategories, StatusOfSensorAndService) {
  EXPECT_EQ(hex(cat063(made_station(), 11, kSettings)), "3f000cb8190a9c400f190b00");
  Station bad = made_station();
  bad.is_well = bad.clock_is_good = false;
  EXPECT_EQ(hex(cat063(bad, 11, kSettings)), "3f000db8190a9c400f190b4108");
  EXPECT_EQ(hex(cat065(kNow_us, kSettings)), "41000bd4190a019c400f00");
}

TEST(AsterixCategories, ALineIsAMeasurementTrack) {
  EXPECT_EQ(hex(cat015(made_line(), 11, kSettings)),
            "0f001b"
            "d78101c0"
            "190b"
            "05"
            "00"
            "9c400f"
            "0003"
            "00"
            "a04000000f"
            "a002d8001e");
}

}  // namespace
}  // namespace ols::exports
