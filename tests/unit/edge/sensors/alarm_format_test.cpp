#include "edge/sensors/alarm_format.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::sensors {
namespace {

TEST(AlarmFormat, ALengthHasTheUnitThatSuitsIt) {
  EXPECT_EQ(format_length(0.0), "0.00 m");
  EXPECT_EQ(format_length(0.314), "0.31 m");
  EXPECT_EQ(format_length(103.4), "103 m");
  EXPECT_EQ(format_length(10e3), "10 km");
  EXPECT_EQ(format_length(12'345.0), "12 km");
}

TEST(AlarmFormat, ATimeHasTheUnitThatSuitsIt) {
  EXPECT_EQ(format_time(12.4), "12 s");
  EXPECT_EQ(format_time(119.0), "119 s");
  EXPECT_EQ(format_time(120.0), "2 min");
  EXPECT_EQ(format_time(7199.0), "120 min");
  EXPECT_EQ(format_time(7200.0), "2 h");
}

TEST(AlarmFormat, AnAngleIsInDegrees) { EXPECT_EQ(format_angle(radians(0.314)), "0.31 deg"); }

}  // namespace
}  // namespace ols::sensors
