#include "edge/calibration/calibration_folder.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/calibration/calibration_files.h"

namespace ols::station {
namespace {

using test::covariance_text;
using test::settings;

class CalibrationFolder : public testing::Test {
 protected:
  // Without the folder's name.
  std::string error(const StationSettings& of = settings()) {
    try {
      read_calibration(at_, of);
    } catch (const std::exception& problem) {
      const std::string what = problem.what();
      const auto at = what.find(at_);
      return at == std::string::npos ? what : what.substr(at + at_.size() + 1);
    }
    return "none";
  }
  test::CalibrationFolder files_{"calibration_folder"};
  std::string at_ = files_.path;
};

TEST_F(CalibrationFolder, IsTheStationsModel) {
  const CalibrationFiles files = read_calibration(at_, settings());
  const StationModel& model = files.calibration.model;
  EXPECT_NEAR(degrees(model.geometry.chain.heading_rad), 33.3, 1e-9);
  EXPECT_NEAR(degrees(model.geometry.chain.tilt_x_rad), 0.2, 1e-9);
  EXPECT_NEAR(degrees(model.geometry.position.latitude_rad), 49.225, 1e-12);
  EXPECT_NEAR(model.geometry.chain.trunnion_rad, 1e-4, 1e-9);
  EXPECT_NEAR(model.geometry.camera.fx_px, 13300.0, 1e-4);
  EXPECT_EQ(model.geometry.chain.ground_to_origin_m.z(), 1.7) << "the configuration's levers";
  EXPECT_NEAR(files.calibration.covariance(kFocal, kFocal), 1e-8, 1e-15);
  EXPECT_NEAR(files.calibration.covariance(kEast, kEast), 1e-8 * (kEast + 1), 1e-15);
  EXPECT_EQ(files.observed_utime_us, 1780000000000000);
  EXPECT_GT(files.rms_rad, 0.0);
  EXPECT_GE(files.worst_rad, files.rms_rad);
}

TEST_F(CalibrationFolder, ItsSetupIsTheSurveyOfThePose) {
  const CalibrationFiles files = read_calibration(at_, settings());
  const StationSettings with = with_calibration(settings(), files);
  EXPECT_EQ(with.calibration_id, files.id);
  EXPECT_TRUE(with.station.calibration);
  EXPECT_NEAR(with.pose.surveyed_position->height_m, 250.5, 1e-9);
  EXPECT_NEAR(degrees(with.pose.surveyed_tilt_rad->y()), -0.1, 1e-9);
  EXPECT_NEAR(degrees(with.station.geometry.chain.heading_rad), 33.3, 1e-9);
  EXPECT_EQ(with.station.geometry.sd.heading_rad, files.rms_rad);
  EXPECT_GT(with.pose.surveyed_position_sd_m, 0.0);
}

TEST_F(CalibrationFolder, AnotherStationsIsRefused) {
  StationSettings other = settings();
  other.id = "bravo";
  EXPECT_EQ(error(other), "setup.toml:3: station: is 'alfa', this is 'bravo'");
}

TEST_F(CalibrationFolder, OtherSerialNumbersAreRefused) {
  StationSettings other = settings();
  other.serials.camera = "C8";
  EXPECT_EQ(error(other),
            "instrument.toml: serials.camera: is of camera 'C7', the station has 'C8'");
  other.serials.camera = "";
  EXPECT_EQ(error(other), "none") << "not stated";
}

TEST_F(CalibrationFolder, AnEditedFileIsFound) {
  files_.put("covariance.csv", covariance_text(2e-8));
  EXPECT_NE(error().find("calibration_id: is not that of the content"), std::string::npos);
  files_.covariance = covariance_text(2e-8);
  files_.write();
  EXPECT_EQ(error(), "none");
}

TEST_F(CalibrationFolder, WhatIsMissingIsNamed) {
  std::filesystem::remove(at_ + "/covariance.csv");
  EXPECT_NE(error().find("covariance.csv"), std::string::npos);
  files_.setup = "station = \"alfa\"\n[pose]\nlatitude_deg = 49\n";
  files_.write();
  EXPECT_NE(error().find("setup.toml"), std::string::npos);
  EXPECT_NE(error().find("is missing"), std::string::npos) << error();
  at_ += "/none";
  EXPECT_NE(error().find("setup.toml"), std::string::npos);
}

TEST_F(CalibrationFolder, AnUnknownKeyIsNamed) {
  files_.setup += "wind = 3\n";
  files_.write();
  EXPECT_NE(error().find("wind"), std::string::npos) << error();
}

}  // namespace
}  // namespace ols::station
