#include "edge/clock/chrony_tracking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace ols::clock {
namespace {

// As chronyc 4.3 writes it for a receiver's pulse; the clock is 72 ns fast.
const std::string kPps =
    "50505300,PPS,1,1713528723.123456789,-0.000000072,-0.000000011,0.000000195,-1.789,-0.000,"
    "0.016,0.000000001,0.000011804,16.0,Normal\n";

std::string with_leap(const std::string& leap) {
  return kPps.substr(0, kPps.rfind(',') + 1) + leap + "\n";
}

TEST(ChronyTracking, ReadsALine) {
  const auto tracking = parse_chrony_tracking(kPps);
  ASSERT_TRUE(tracking);
  EXPECT_EQ(tracking->reference, "PPS");
  EXPECT_TRUE(tracking->synchronised);
  EXPECT_DOUBLE_EQ(tracking->measured_utc_s, 1713528723.123456789);
  EXPECT_DOUBLE_EQ(tracking->offset_s, 72e-9);  // fast: ahead of NTP time
  EXPECT_EQ(tracking->leap_s, 0);
  EXPECT_NEAR(tracking->error_s(), (72e-9 + 11.804e-6 + 0.5e-9) / std::sqrt(3.0), 1e-12);
}

TEST(ChronyTracking, NotSynchronised) {
  const auto tracking = parse_chrony_tracking(
      "00000000,,0,0.000000000,0.000000000,0.000000000,0.000000000,0.000,0.000,0.000,1.000000000,"
      "1.000000000,0.0,Not synchronised\n");
  ASSERT_TRUE(tracking);
  EXPECT_FALSE(tracking->synchronised);
}

TEST(ChronyTracking, ItsOwnFreeRunningClockIsNoSynchronisation) {
  // As chronyd 4.3 with "local stratum 8" and no source answers.
  const auto tracking = parse_chrony_tracking(
      "7F7F0101,,8,1795231713.300112228,0.000000000,0.000000000,0.000000000,0.000,0.000,0.000,"
      "0.000000000,0.000000000,0.0,Normal\n");
  ASSERT_TRUE(tracking);
  EXPECT_FALSE(tracking->synchronised);
  EXPECT_EQ(tracking->reference, "local clock");
}

TEST(ChronyTracking, AnnouncedLeapSeconds) {
  EXPECT_EQ(parse_chrony_tracking(with_leap("Insert second"))->leap_s, 1);
  EXPECT_EQ(parse_chrony_tracking(with_leap("Delete second"))->leap_s, -1);
  EXPECT_TRUE(parse_chrony_tracking(with_leap("Insert second"))->synchronised);
  EXPECT_FALSE(parse_chrony_tracking(with_leap("Invalid"))->synchronised);
}

TEST(ChronyTracking, RefusesWhatIsNoSuchLine) {
  EXPECT_FALSE(parse_chrony_tracking(""));
  EXPECT_FALSE(parse_chrony_tracking("506 Cannot talk to daemon\n"));
  EXPECT_FALSE(parse_chrony_tracking(kPps.substr(0, 40)));
  EXPECT_FALSE(parse_chrony_tracking("x," + kPps));
  std::string nan = kPps;
  nan.replace(nan.find("0.000011804"), 11, "nan");
  EXPECT_FALSE(parse_chrony_tracking(nan));
  std::string negative = kPps;
  negative.replace(negative.find("0.000011804"), 11, "-0.00001180");
  EXPECT_FALSE(parse_chrony_tracking(negative));
}

}  // namespace
}  // namespace ols::clock
