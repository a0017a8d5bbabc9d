#include "central/admission/clock_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace ols::fusion {
namespace {

constexpr double kPeriod_s = 1.0 / 15.0;

// Stations at 15 Hz, each with its clock offset, message delay and stated error.
class ClockMonitorTest : public testing::Test {
 protected:
  struct Clock {
    double offset_s = 0.0;
    double late_s = 0.0;
    double error_s = 1e-3;
    StationClock says = StationClock::kUnknown;
  };

  void run(double seconds) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s; now_s_ += kPeriod_s) {
      double phase_s = 0.0;
      for (const auto& [name, clock] : clocks_) {
        phase_s += kPeriod_s / 8.0;
        BearingMeasurement measurement;
        measurement.station = name;
        measurement.utime_us =
            1'000'000'000 + std::llround(1e6 * (now_s_ + phase_s + clock.offset_s - clock.late_s));
        measurement.clock_sd_s = clock.error_s;
        measurement.clock = clock.says;
        time_.hear(name, measurement.utime_us);
        monitor_.hear(measurement, time_);
      }
    }
  }
  std::string quarantined() const {
    std::string names;
    for (const auto& [name, clock] : clocks_) {
      if (!monitor_.quarantine(name).empty()) names += name;
    }
    return names;
  }

  std::map<std::string, Clock> clocks_ = {{"a", {}}, {"b", {}}, {"c", {}}};
  double now_s_ = 0.0;
  MessageTime time_{0.3};
  ClockMonitor monitor_;
};

TEST_F(ClockMonitorTest, GoodClocksAreBelieved) {
  run(5.0);
  EXPECT_EQ(quarantined(), "");
  EXPECT_EQ(monitor_.added_sd_s("a"), 0.0);
  EXPECT_LT(std::abs(monitor_.offset_s("b")), 0.1);
  EXPECT_TRUE(std::isnan(monitor_.offset_s("nobody")));
}

TEST_F(ClockMonitorTest, AMarkQuarantinesAtOnceAndOnlyItsStation) {
  run(2.0);
  clocks_["b"].error_s = 2.0;
  run(kPeriod_s);
  EXPECT_EQ(quarantined(), "b");
  run(10.0);
  EXPECT_EQ(quarantined(), "b");
}

TEST_F(ClockMonitorTest, BetweenTwoStationsOnlyTheMarkTells) {
  clocks_.erase("c");
  run(2.0);
  clocks_["a"].offset_s = 2.0;
  run(2.0);
  EXPECT_EQ(quarantined(), "") << "one of them is wrong, but which?";
  clocks_["a"].error_s = 2.0;
  run(kPeriod_s);
  EXPECT_EQ(quarantined(), "a");
}

TEST_F(ClockMonitorTest, WhereNobodyHasABetterClockNobodyIsSetAside) {
  for (auto& [name, clock] : clocks_) {
    clock.error_s = 1.0;
    clock.says = StationClock::kUnsynchronised;
  }
  run(5.0);
  EXPECT_EQ(quarantined(), "");
}

TEST_F(ClockMonitorTest, AStepThatNobodyMarksIsSeenByComparison) {
  for (const double step_s : {2.0, -2.0}) {
    clocks_["c"].offset_s = 0.0;
    run(10.0);
    ASSERT_EQ(quarantined(), "");
    clocks_["c"].offset_s = step_s;
    run(1.5);
    EXPECT_EQ(quarantined(), "c") << step_s;
  }
}

TEST_F(ClockMonitorTest, IsBelievedAgainAfterAWhile) {
  clocks_["b"].error_s = 2.0;
  run(2.0);
  clocks_["b"].error_s = 1e-3;
  run(2.0);
  EXPECT_EQ(quarantined(), "b") << "not yet";
  run(2.0);
  EXPECT_EQ(quarantined(), "");
}

TEST_F(ClockMonitorTest, DoesNotFlutterAroundItsLimit) {
  clocks_["b"].error_s = 0.11;
  run(1.0);
  ASSERT_EQ(quarantined(), "b");
  clocks_["b"].error_s = 0.08;  // below the limit, but not by enough
  run(10.0);
  EXPECT_EQ(quarantined(), "b");
}

TEST_F(ClockMonitorTest, LatenessOfASynchronisedStationIsNotAWrongClock) {
  clocks_["b"].late_s = 0.7;
  clocks_["b"].says = StationClock::kSynchronised;
  run(5.0);
  EXPECT_EQ(quarantined(), "");
  EXPECT_EQ(monitor_.added_sd_s("b"), 0.0);
  clocks_["b"].says = StationClock::kUnknown;
  run(2.0);
  EXPECT_EQ(quarantined(), "b");
}

TEST_F(ClockMonitorTest, ADoubtInflates) {
  clocks_["b"].offset_s = 0.3;
  run(5.0);
  EXPECT_EQ(quarantined(), "");
  EXPECT_NEAR(monitor_.added_sd_s("b"), 0.3 - ClockMonitorConfig{}.usual_offset_s, 0.07);
  EXPECT_EQ(monitor_.added_sd_s("a"), 0.0);
}

TEST_F(ClockMonitorTest, AFewStrayStampsAreNoClock) {
  run(5.0);
  clocks_["b"].offset_s = 3.0;
  run(0.3);
  clocks_["b"].offset_s = 0.0;
  run(1.0);
  EXPECT_EQ(quarantined(), "");
}

}  // namespace
}  // namespace ols::fusion
