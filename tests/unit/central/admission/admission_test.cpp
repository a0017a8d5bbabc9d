#include "central/admission/admission.h"

#include <gtest/gtest.h>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart_us = 1'600'000'000'000'000;

// Bearings of two stations, a every 0.1 s.
class AdmissionTest : public testing::Test {
 protected:
  BearingMeasurement bearing(const std::string& station, double time_s) const {
    auto measurement = test::measurement_of(test::ray_to(station, {0, 0, 0}, {100, 100, 50}),
                                            kStart_us + std::llround(1e6 * time_s));
    measurement.track_id = 1;
    return measurement;
  }
  BearingRefusal admit(const BearingMeasurement& measurement) {
    last_ = admission_.admit(measurement, log_);
    return last_.refusal;
  }
  BearingRefusal admit(const std::string& station, double time_s) {
    return admit(bearing(station, time_s));
  }
  void begin(const AdmissionConfig& config) { admission_ = Admission(config); }

  Admission admission_{AdmissionConfig{}};
  FusionLog log_;
  Admitted last_;
};

TEST_F(AdmissionTest, UntimelyBearingsInARowAreCounted) {
  const double stale_s = AdmissionConfig{}.stale_s;
  for (int i = 0; i <= 20; ++i) admit("a", 0.1 * i);
  for (int i = 1; i <= 2; ++i) {
    EXPECT_EQ(admit("a", 2.0 - stale_s - 0.05 + 0.01 * i), BearingRefusal::kStale);
    EXPECT_EQ(last_.station->untimely, i);
  }
  EXPECT_EQ(admit("a", 2.1), BearingRefusal::kNone);
  EXPECT_EQ(last_.station->untimely, 0);
}

TEST_F(AdmissionTest, AGoodBearingIsAdmittedWithItsStation) {
  EXPECT_EQ(admit("a", 0.0), BearingRefusal::kNone);
  ASSERT_NE(last_.station, nullptr);
  EXPECT_EQ(last_.station->bearings, 1);
  EXPECT_FALSE(last_.recalibrated || last_.restarted) << "it is the first one";
  EXPECT_EQ(log_.counters["bearings"], 1.0);
}

TEST_F(AdmissionTest, ABrokenBearingMakesNoStationKnown) {
  BearingMeasurement broken = bearing("a", 0.0);
  broken.sight.covariance_white(0, 0) = -1.0;
  EXPECT_EQ(admit(broken), BearingRefusal::kCovariance);
  EXPECT_TRUE(admission_.stations().all().empty());
}

TEST_F(AdmissionTest, OnlyStationsOfTheSiteAreAdmitted) {
  AdmissionConfig config;
  config.stations = {"a"};
  begin(config);
  EXPECT_EQ(admit("stranger", 0.0), BearingRefusal::kUnknown);
  EXPECT_EQ(admit("a", 0.0), BearingRefusal::kNone);
  EXPECT_FALSE(admission_.know_station("stranger", {}, log_));
  EXPECT_EQ(admission_.stations().all().size(), 1U);
}

TEST_F(AdmissionTest, ABearingIsAdmittedOnce) {
  EXPECT_EQ(admit("a", 0.0), BearingRefusal::kNone);
  EXPECT_EQ(admit("a", 0.1), BearingRefusal::kNone);
  EXPECT_EQ(admit("a", 0.0), BearingRefusal::kDuplicate);
  EXPECT_EQ(admit("b", 0.0), BearingRefusal::kNone) << "another station's of the same instant";
}

TEST_F(AdmissionTest, ALateBearingIsAdmittedUntilItIsStale) {
  const double stale_s = AdmissionConfig{}.stale_s;
  for (int i = 0; i <= 20; ++i) admit("a", 0.1 * i);
  EXPECT_EQ(admit("a", 2.0 - stale_s + 0.05), BearingRefusal::kNone);
  EXPECT_EQ(admit("a", 2.0 - stale_s - 0.05), BearingRefusal::kStale);
}

TEST_F(AdmissionTest, AnUnlikelyBearingIsNotUsed) {
  BearingMeasurement measurement = bearing("a", 0.0);
  measurement.belief = AdmissionConfig{}.min_belief;
  EXPECT_EQ(admit(measurement), BearingRefusal::kNone);
  measurement = bearing("a", 0.1);
  measurement.belief = AdmissionConfig{}.min_belief - 0.01;
  EXPECT_EQ(admit(measurement), BearingRefusal::kLowBelief);
}

TEST_F(AdmissionTest, ARestartAndANewCalibrationAreNoticedOnce) {
  admit("a", 0.0);
  BearingMeasurement measurement = bearing("a", 0.1);
  measurement.boot_id = 7;
  EXPECT_EQ(admit(measurement), BearingRefusal::kNone);
  EXPECT_TRUE(last_.restarted);
  EXPECT_FALSE(last_.recalibrated);
  measurement = bearing("a", 0.2);
  measurement.boot_id = 7;
  measurement.calibration_id = 3;
  admit(measurement);
  EXPECT_FALSE(last_.restarted);
  EXPECT_TRUE(last_.recalibrated);
  EXPECT_EQ(log_.counters["stations_restarted"], 1.0);
  EXPECT_EQ(log_.counters["calibrations_changed"], 1.0);
}

TEST_F(AdmissionTest, ARefusedBearingChangesNothingOfItsStation) {
  admit("a", 0.0);
  BearingMeasurement measurement = bearing("a", 0.1);
  measurement.boot_id = 7;
  measurement.belief = 0.0;
  admit(measurement);
  EXPECT_FALSE(last_.restarted);
  EXPECT_EQ(admission_.stations().all().at("a").bearings, 1);
}

TEST_F(AdmissionTest, AFloodIsCutOff) {
  AdmissionConfig config;
  config.flood_hz = 50.0;
  begin(config);
  int admitted = 0;
  for (int i = 0; i < 1000; ++i) {
    admitted += admit("a", 0.001 * i) == BearingRefusal::kNone ? 1 : 0;
  }
  EXPECT_EQ(last_.refusal, BearingRefusal::kFlood);
  EXPECT_GE(admitted, 50);
  EXPECT_LT(admitted, 500);
}

TEST_F(AdmissionTest, AStationThatStillDeliversIsNotReplaced) {
  AdmissionConfig config;
  config.max_stations = 2;
  begin(config);
  for (int i = 0; i < 10; ++i) {
    admit("a", 0.1 * i);
    admit("b", 0.1 * i);
  }
  EXPECT_EQ(admit("c", 1.0), BearingRefusal::kTooMany);
  for (int i = 10; i <= 120; ++i) admit("b", 0.1 * i);  // a has fallen silent
  EXPECT_EQ(admit("c", 12.0), BearingRefusal::kNone);
  EXPECT_EQ(last_.evicted, "a");
  EXPECT_EQ(log_.counters["stations_evicted"], 1.0);
  EXPECT_FALSE(admission_.stations().all().contains("a"));
}

TEST_F(AdmissionTest, SlewsAreAllowedOfAKnownStation) {
  admit("a", 0.0);
  admission_.allow_slews("a", false);
  admission_.allow_slews("stranger", false);
  EXPECT_FALSE(admission_.stations().all().at("a").traits.commandable);
  EXPECT_FALSE(admission_.stations().all().contains("stranger"));
}

}  // namespace
}  // namespace ols::fusion
