#include "tools/calibrate/delay_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "tests/unit/base/bus/log_file.h"

namespace ols::calibration {
namespace {

using Eigen::Vector3d;
using Message = ols_msg::bearing_t;

constexpr double kLate_s = 0.12, kSd_rad = 4e-4;
const LocalFrame kSite({radians(49.2), radians(16.6), 300.0});

Vector3d eights(double time_s) {
  return {40.0 * std::sin(0.21 * time_s), 30.0 * std::sin(0.42 * time_s), 70.0};
}

Message bearing(const std::string& station, const Vector3d& camera, double time_s, double late_s,
                std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, kSd_rad);
  Message m{};
  m.schema_version = Message::SCHEMA_VERSION;
  m.utime = kStart_us + std::llround(1e6 * (time_s + late_s));
  m.station = station;
  m.boot_id = 5;
  m.track_id = 3;
  m.belief = 0.9;
  const Vector3d ecef = kSite.to_ecef(camera);
  Vector3d::Map(m.camera_ecef_m) = ecef;
  const Vector3d way = kSite.to_ecef(eights(time_s)) - ecef;
  const auto at = azimuth_elevation_from_enu(R_ecef_enu(ecef).transpose() * way);
  m.azimuth_rad = at.azimuth_rad + noise(random) / std::cos(at.elevation_rad);
  m.elevation_rad = at.elevation_rad + noise(random);
  m.covariance_white_rad2[0] = m.covariance_white_rad2[2] = kSd_rad * kSd_rad;
  m.covariance_systematic_rad2[0] = m.covariance_systematic_rad2[2] = 1e-6;
  m.camera_position_sd_m[0] = m.camera_position_sd_m[1] = m.camera_position_sd_m[2] = 0.05;
  m.clock_state = Message::CLOCK_SYNCHRONISED;
  m.stamp_source = station == "cam" ? Message::STAMP_ARRIVAL : Message::STAMP_CAMERA;
  m.clock_error_s = station == "cam" ? 0.3 : 1e-3;
  return m;
}

std::string recorded(std::int8_t later_source = Message::STAMP_ARRIVAL) {
  std::mt19937_64 random(4);
  std::string bytes;
  for (double time_s = 0.0; time_s < 60.0; time_s += 0.1) {
    for (const std::string station : {"cam", "east", "north"}) {
      const Vector3d camera = station == "cam"    ? Vector3d(-150.0, -100.0, 0.0)
                              : station == "east" ? Vector3d(150.0, -100.0, 2.0)
                                                  : Vector3d(0.0, 180.0, 1.0);
      Message m = bearing(station, camera, time_s, station == "cam" ? kLate_s : 0.0, random);
      if (station == "cam" && time_s > 30.0) m.stamp_source = later_source;
      bytes += log_record(m.utime, "OLS_BEARING_" + station, payload_of(m));
    }
  }
  return bytes;
}

class DelayCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    write("id = \"cam\"\n\n[camera]\nkind = \"rtsp\"\ndelay_s = 0.25  # of the data sheet\n");
  }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  std::string text() const {
    std::stringstream all;
    all << std::ifstream(path_).rdbuf();
    return all.str();
  }

  const std::string path_ = ::testing::TempDir() + "/delay_command_test.toml";
};

TEST_F(DelayCommand, WritesTheDelayIntoTheConfiguration) {
  const LogFile log(recorded());
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(run_delay({path_, {log.path()}, true}), 0);
  const std::string said = ::testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("too late"), std::string::npos) << said;
  const std::string after = text();
  const std::size_t at = after.find("delay_s = ");
  ASSERT_NE(at, std::string::npos) << after;
  EXPECT_NEAR(std::stod(after.substr(at + 10)), 0.25 + kLate_s, 0.015) << after;
  EXPECT_NE(after.find("# of the data sheet"), std::string::npos) << after;
  const std::size_t sd = after.find("delay_sd_s = ");
  ASSERT_NE(sd, std::string::npos) << after;
  EXPECT_LT(std::stod(after.substr(sd + 13)), 0.01) << after;
}

TEST_F(DelayCommand, ReportsAndArrivalsHaveDelaysOfTheirOwn) {
  const LogFile log(recorded(Message::STAMP_CAMERA));
  EXPECT_THROW(run_delay({path_, {log.path()}, true}), std::runtime_error);
  EXPECT_NE(text().find("delay_s = 0.25  #"), std::string::npos);
}

TEST_F(DelayCommand, AStationWithoutBearingsOrWithAnotherCameraIsRefused) {
  const LogFile log(recorded());
  write("id = \"other\"\n\n[camera]\nkind = \"rtsp\"\n");
  EXPECT_THROW(run_delay({path_, {log.path()}, false}), std::runtime_error);
  write("id = \"east\"\n\n[camera]\nkind = \"gige\"\n");
  EXPECT_THROW(run_delay({path_, {log.path()}, false}), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
