#include "edge/calibration/active_calibration.h"

#include <gtest/gtest.h>

#include "conditions/alarm.h"
#include "tests/unit/edge/calibration/calibration_files.h"

namespace ols::station {
namespace {

class ActiveCalibrationTest : public testing::Test {
 protected:
  StationSettings configured() const {
    StationSettings settings = test::settings();
    settings.calibration_folder = files_.path;
    return settings;
  }
  static device::DeviceReport camera(const std::string& serial) {
    device::DeviceReport report;
    report.name = "camera";
    report.serial = serial;
    return report;
  }
  test::CalibrationFolder files_{"active_calibration"};
};

TEST_F(ActiveCalibrationTest, NoneConfiguredIsNothingToSay) {
  const ActiveCalibration none(test::settings());
  EXPECT_EQ(none.status().state, CalibrationState::kNone);
  EXPECT_EQ(none.settings().calibration_id, 5);
  EXPECT_FALSE(none.settings().station.calibration);
  EXPECT_TRUE(none.alarms().empty());
}

TEST_F(ActiveCalibrationTest, TheStationWorksWithIt) {
  const ActiveCalibration used(configured());
  EXPECT_EQ(used.status().state, CalibrationState::kInUse);
  EXPECT_EQ(used.status().observed_utime_us, 1780000000000000);
  EXPECT_EQ(used.settings().calibration_id, used.status().id);
  EXPECT_TRUE(used.settings().station.calibration);
  EXPECT_TRUE(used.alarms().empty());
}

TEST_F(ActiveCalibrationTest, AnUnreadableOneIsNamedAndTheStationGoesOn) {
  files_.put("instrument.toml", "rubbish = 1\n");
  const ActiveCalibration refused(configured());
  EXPECT_EQ(refused.status().state, CalibrationState::kRefused);
  EXPECT_EQ(refused.settings().calibration_id, 5) << "its own values";
  EXPECT_FALSE(refused.settings().station.calibration);
  ASSERT_EQ(refused.alarms().size(), 1U);
  EXPECT_NE(refused.alarms().front().text.find("instrument.toml:1: rubbish"), std::string::npos);
}

// Without a calibration, too: the next one would be stored under the configured serial numbers.
TEST_F(ActiveCalibrationTest, ADeviceThatSaysAnotherSerialNumberIsNamed) {
  InstrumentSerials configured;
  configured.camera = "C7";
  EXPECT_TRUE(ActiveCalibration::other_devices(configured, {camera(""), camera("C7")}).empty());
  EXPECT_TRUE(ActiveCalibration::other_devices(InstrumentSerials{}, {camera("C8")}).empty())
      << "none is configured";
  const auto others = ActiveCalibration::other_devices(configured, {camera("C8")});
  ASSERT_EQ(others.size(), 1U);
  EXPECT_EQ(others[0].text,
            "calibration: another camera than configured: it says 'C8', [serials] has 'C7'");
  EXPECT_EQ(others[0].id, "other_device") << "by this a guided procedure knows the alarm";
}

TEST_F(ActiveCalibrationTest, ACameraThatIsAnotherEndsIt) {
  ActiveCalibration used(configured());
  EXPECT_FALSE(used.refuses({camera("")})) << "it does not say";
  EXPECT_FALSE(used.refuses({camera("C7")}));
  EXPECT_TRUE(used.refuses({camera("C8")}));
  EXPECT_FALSE(used.refuses({camera("C8")})) << "once";
  EXPECT_EQ(used.status().state, CalibrationState::kRefused);
  EXPECT_FALSE(used.settings().station.calibration);
  EXPECT_NE(used.alarms().front().text.find("is of camera 'C7', the camera says 'C8'"),
            std::string::npos);
}

TEST_F(ActiveCalibrationTest, AUnitInAnotherStepModeEndsIt) {
  StationSettings settings = configured();
  settings.station.geometry.sd.heading_rad = radians(0.5);
  ActiveCalibration used(settings);
  const double count = radians(11.5714 / 3600.0);
  EXPECT_FALSE(used.refuses(PanTilt{})) << "it does not say yet";
  EXPECT_FALSE(used.refuses(PanTilt{count, count}));
  EXPECT_LT(used.settings().station.geometry.sd.heading_rad, radians(0.5));
  EXPECT_TRUE(used.refuses(PanTilt{count, 2.0 * count}));
  EXPECT_FALSE(used.refuses(PanTilt{count, 2.0 * count})) << "once";
  EXPECT_EQ(used.status().state, CalibrationState::kRefused);
  EXPECT_FALSE(used.settings().station.calibration);
  EXPECT_EQ(used.settings().station.geometry.sd.heading_rad, radians(0.5)) << "as configured";
  ASSERT_EQ(used.alarms().size(), 1U);
  EXPECT_NE(used.alarms().front().text.find("the unit has another number of counts per turn"),
            std::string::npos);
}

}  // namespace
}  // namespace ols::station
