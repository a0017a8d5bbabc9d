#include "tools/calibrate/aircraft.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::calibration {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

// Two passes of one aircraft, mixed with one that was heard once; one instant came twice.
TEST(ReferenceRows, ArePassesInTheOrderOfTime) {
  const auto at = [](const char* icao, int second) {
    return AircraftPosition{icao, 1'780'000'000 * kSecond_us + second * kSecond_us, 49.5, 16.25,
                            10000.0};
  };
  const std::string rows = reference_rows({at("bbbbbb", 5), at("aaaaaa", 2), at("aaaaaa", 0),
                                           at("aaaaaa", 2), at("aaaaaa", 100), at("aaaaaa", 101)},
                                          12.0);
  EXPECT_EQ(rows,
            "landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us\n"
            "aaaaaa,49.5000000,16.2500000,10000.0,12.0,1780000000000000\n"
            "aaaaaa,49.5000000,16.2500000,10000.0,12.0,1780000002000000\n"
            "aaaaaa-2,49.5000000,16.2500000,10000.0,12.0,1780000100000000\n"
            "aaaaaa-2,49.5000000,16.2500000,10000.0,12.0,1780000101000000\n");
}

TEST(ReceiverClock, WhatIsSlowOrAheadIsNamed) {
  for (const double usual_s : {0.01, 0.3, 1.2}) {
    EXPECT_EQ(receiver_clock_trouble(std::llround(1e6 * usual_s)), "") << usual_s;
  }
  EXPECT_NE(receiver_clock_trouble(3 * kSecond_us).find("3.0 s old"), std::string::npos);
  EXPECT_NE(receiver_clock_trouble(59 * kSecond_us).find("59.0 s old"), std::string::npos);
  EXPECT_NE(receiver_clock_trouble(-kSecond_us / 5).find("0.2 s ahead"), std::string::npos)
      << "nothing comes before it was sent";
}

}  // namespace
}  // namespace ols::calibration
