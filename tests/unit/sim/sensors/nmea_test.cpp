#include "sim/sensors/nmea.h"

#include <gtest/gtest.h>

#include <sstream>

#include "geometry/angles.h"

namespace ols::sim {
namespace {

// 2026-11-21 03:15:05.48 UTC
constexpr std::int64_t kUtime_us = 1'795'230'905'480'000;

NmeaEpoch epoch() {
  NmeaEpoch e;
  e.utime_us = kUtime_us;
  e.antenna = {radians(49.2266), radians(-16.5969), 310.0};
  e.sd_enu_m = {0.010, 0.012, 0.020};
  return e;
}

std::string sentence(const std::string& all, const std::string& name) {
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("$" + name, 0) == 0) return line.substr(0, line.find('*'));
  }
  return {};
}

TEST(Nmea, ChecksumIsThatOfTheStandard) {
  // A sentence of a real receiver, as it stands in many manuals.
  EXPECT_EQ(nmea_sentence("GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,"),
            "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n");
}

TEST(Nmea, AnRtkFix) {
  const std::string all = nmea_epoch(epoch());
  EXPECT_EQ(sentence(all, "GNGGA"),
            "$GNGGA,031505.48,4913.5960000,N,01635.8140000,W,4,14,0.70,266.0000,M,44.0000,M,1.0,"
            "0001");
  EXPECT_EQ(sentence(all, "GNRMC"),
            "$GNRMC,031505.48,A,4913.5960000,N,01635.8140000,W,0.00,,211126,,,R,V");
  EXPECT_EQ(sentence(all, "GNGST"),
            "$GNGST,031505.48,0.0254,0.0120,0.0100,0.0,0.0120,0.0100,0.0200");
  EXPECT_EQ(sentence(all, "GNGSA"), "$GNGSA,A,3,01,02,03,04,05,06,07,08,,,,,1.20,0.70,1.00,1");
}

TEST(Nmea, WithoutAFixThereIsNoPosition) {
  NmeaEpoch e = epoch();
  e.has_fix = false;
  const std::string all = nmea_epoch(e);
  EXPECT_EQ(sentence(all, "GNGGA"), "$GNGGA,031505.48,,,,,0,00,99.99,,,,,,");
  EXPECT_EQ(sentence(all, "GNRMC"), "$GNRMC,031505.48,V,,,,,,,211126,,,N,V");
}

TEST(Nmea, MinutesNeverReachSixty) {
  NmeaEpoch e = epoch();
  e.antenna.latitude_rad = radians(50.0 - 1e-13);
  EXPECT_NE(sentence(nmea_epoch(e), "GNGGA").find(",5000.0000000,N,"), std::string::npos);
}

}  // namespace
}  // namespace ols::sim
