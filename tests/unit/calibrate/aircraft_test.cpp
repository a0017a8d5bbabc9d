#include "tools/calibrate/aircraft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "tests/unit/base/bus/log_file.h"

namespace ols::calibration {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

const std::string kHeard =
    R"({"now": 1780000000, "aircraft": [{"hex": "4ca2d6", "lat": 49.5, "lon": 16.25,)"
    R"( "alt_geom": 33000, "seen_pos": 0.5}]})";

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

TEST(WriteAircraft, TellsHowManyBytesOfAllInputsHaveCome) {
  std::string later = kHeard;
  later.replace(later.find("1780000000"), 10, "1780000001");
  const LogFile first(kHeard), second(later);
  const auto output = std::filesystem::temp_directory_path() / "ols_calibrate_aircraft_test.csv";
  AircraftOptions options;
  options.inputs = {first.path(), second.path()};
  options.format = "json";
  options.output = output.string();
  std::filesystem::remove(output);
  std::vector<std::pair<std::size_t, std::size_t>> told;
  write_aircraft(options, [&](std::size_t done, std::size_t all) { told.emplace_back(done, all); });
  std::filesystem::remove(output);
  const std::size_t size = kHeard.size();
  EXPECT_EQ(told, (std::vector<std::pair<std::size_t, std::size_t>>{{size, 2 * size},
                                                                    {2 * size, 2 * size}}));
}

}  // namespace
}  // namespace ols::calibration
