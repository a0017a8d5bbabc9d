#include "tools/calibrate/delay_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <sstream>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "tests/unit/base/bus/log_file.h"
#include "tests/unit/error_text.h"
#include "tests/unit/temporary_folder.h"
#include "tools/calibrate/bearing_log.h"

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

using Change = std::function<void(Message&)>;

std::string recorded(const Change& change = [](Message&) {}) {
  std::mt19937_64 random(4);
  std::string bytes;
  for (double time_s = 0.0; time_s < 60.0; time_s += 0.1) {
    for (const std::string station : {"cam", "east", "north"}) {
      const Vector3d camera = station == "cam"    ? Vector3d(-150.0, -100.0, 0.0)
                              : station == "east" ? Vector3d(150.0, -100.0, 2.0)
                                                  : Vector3d(0.0, 180.0, 1.0);
      Message m = bearing(station, camera, time_s, station == "cam" ? kLate_s : 0.0, random);
      if (station == "cam") change(m);
      bytes += log_record(m.utime, "OLS_BEARING_" + station, payload_of(m));
    }
  }
  return bytes;
}

class DelayCommand : public ::testing::Test {
 protected:
  void SetUp() override { write("delay_s = 0.25  # of the data sheet\n"); }
  // The configuration of a station with these keys in [camera].
  void write(const std::string& delays, const std::string& id = "cam",
             const std::string& camera = kRtsp) const {
    std::ofstream(path_) << "id = \"" << id << "\"\nlens = {fx_px = 1e4, fy_px = 1e4}\n\n[camera]\n"
                         << camera << delays
                         << "\n[ptu]\ndevice = \"p\"\n\n[pose]\nheading_deg = 10\n"
                            "latitude_deg = 49.2\nlongitude_deg = 16.6\nheight_m = 250.0\n\n"
                            "[calibration.sd]\nheading_deg = 0.1\nmount_deg = 0.1\n"
                            "tilt_deg = 0.1\nposition_m = 0.5\n";
  }
  // What the command says when it refuses.
  std::string refusal(const LogFile& log) const {
    return error_text<std::runtime_error>([&] { run_delay({path_, {log.path()}, true}); });
  }
  std::string text() const {
    std::stringstream all;
    all << std::ifstream(path_).rdbuf();
    return all.str();
  }

  static constexpr const char* kRtsp = "kind = \"rtsp\"\nurl = \"rtsp://10.0.0.5/s\"\n";
  static constexpr const char* kV4l2 = "kind = \"v4l2\"\ndevice = \"/dev/video0\"\n";
  const std::string path_ = ::testing::TempDir() + "/delay_command_test.toml";
};

TEST_F(DelayCommand, WritesTheDelayIntoTheConfiguration) {
  const LogFile log(recorded());
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(run_delay({path_, {log.path()}, true}), 0);
  const std::string said = ::testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("too late, measured at "), std::string::npos) << said;
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
  const LogFile log(recorded([](Message& m) {
    if (m.utime > kStart_us + 30'000'000) m.stamp_source = Message::STAMP_CAMERA;
  }));
  EXPECT_THROW(run_delay({path_, {log.path()}, true}), std::runtime_error);
  EXPECT_NE(text().find("delay_s = 0.25  #"), std::string::npos);
}

TEST_F(DelayCommand, AStationWithoutBearingsOrWithAnotherCameraIsRefused) {
  const LogFile log(recorded());
  write("", "other");
  EXPECT_THROW(run_delay({path_, {log.path()}, false}), std::runtime_error);
  write("", "east", "device = \"c\"\n");
  EXPECT_THROW(run_delay({path_, {log.path()}, false}), std::invalid_argument);
}

// The driver of a USB camera may stamp a picture before the middle of its exposure; a picture from
// the network cannot arrive before it.
TEST_F(DelayCommand, WhatTheConfigurationRefusesIsRefused) {
  const LogFile early(recorded([](Message&m) { m.utime -= 400'000; })), late(recorded());
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(refusal(early), "camera.delay_s would be -0.0")) << refusal(early);
  EXPECT_NE(text().find("delay_s = 0.25  #"), std::string::npos);
  write("delay_s = 0.95\n", "cam", kV4l2);
  EXPECT_TRUE(has(refusal(late), "camera.delay_s would be 1.0")) << refusal(late);
  write("", "cam", kV4l2);
  EXPECT_EQ(refusal(early), "");
  EXPECT_TRUE(has(text(), "delay_s = -0.2")) << text();
}

TEST_F(DelayCommand, ABadConfigurationIsNamed) {
  const LogFile log(recorded());
  std::ofstream(path_) << "id = \n";
  EXPECT_EQ(refusal(log).find(path_ + ":1"), 0U) << refusal(log);
}

TEST_F(DelayCommand, BearingsThatAreLeftOutAreCounted) {
  const LogFile lost(recorded([](Message& m) { m.clock_state = Message::CLOCK_UNSYNCHRONISED; }));
  EXPECT_NE(refusal(lost).find("600 bearings of stations that did not know the time"),
            std::string::npos)
      << refusal(lost);
  const LogFile doubted(recorded([](Message& m) { m.belief = 0.4; }));
  EXPECT_NE(refusal(doubted).find("600 bearings were hardly believed"), std::string::npos)
      << refusal(doubted);
}

TEST(BearingLog, ABearingInTwoRecordingsCountsOnce) {
  const LogFile first(recorded()), second(recorded() + recorded());
  EXPECT_EQ(read_bearings({first.path(), second.path()}).bearings.size(),
            read_bearings({first.path()}).bearings.size());
}

constexpr double kLightLate_s = 0.03, kReadout_s = 0.02;
const BlinkingLight kSeventh{.period_s = 1.0 / 7.0, .lit_s = 0.05};

// An event of 20 s: a light in the middle row, and a lamp beside it that flickers at random. The
// rows are exposed one after the other.
class DelayByLight : public DelayCommand {
 protected:
  void SetUp() override {
    DelayCommand::SetUp();
    write("delay_s = 0.25\nrow_readout_s = 0.02\n");
    film("arrival");
  }
  void film(const std::string& source_of_last) const {
    constexpr double kInterval_s = 0.0401, kExposure_s = 0.01;
    constexpr int kPictures = 500;
    std::mt19937 random(3);
    std::ofstream table(event_.path() + "/frames.csv");
    table << "utime_us,number,file,mid_exposure_sd_s,pixel_format,stamp_source\n";
    for (int i = 0; i < kPictures; ++i) {
      const double first_row_s = kInterval_s * i, row_s = first_row_s + 0.5 * kReadout_s;
      int lit = 0;
      for (int k = 0; k < 20; ++k) {
        const double at_s = row_s + kExposure_s * ((k + 0.5) / 20.0 - 0.5) + kSeventh.period_s;
        lit += std::fmod(at_s, kSeventh.period_s) < kSeventh.lit_s ? 1 : 0;
      }
      cv::Mat1b gray(48, 64, std::uint8_t{30});
      cv::randn(gray, 30.0, 2.0);
      gray(cv::Rect(40, 24, 3, 3)) += 5.0 * lit;
      gray(cv::Rect(10, 10, 4, 4)) += random() % 150;
      const std::int64_t utime_us =
          kStart_us - kStart_us % 1'000'000 + std::llround(1e6 * (first_row_s + kLightLate_s));
      const std::string file = std::to_string(utime_us) + ".png";
      cv::imwrite(event_.path() + "/" + file, gray);
      table << utime_us << ',' << i << ',' << file << ",0.001,Mono8,"
            << (i + 1 == kPictures ? source_of_last : "arrival") << '\n';
    }
  }
  std::string refusal(const BlinkingLight& light) const {
    return error_text<std::runtime_error>([&] {
      run_delay({path_, {}, true, event_.path(), light});
    });
  }

  const TemporaryFolder event_;
};

TEST_F(DelayByLight, WritesTheDelayIntoTheConfiguration) {
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(run_delay({path_, {}, true, event_.path(), kSeventh}), 0);
  const std::string said = ::testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("pixel 41, 25 of 500 pictures"), std::string::npos) << said;
  const std::string after = text();
  const double delay_s = std::stod(after.substr(after.find("delay_s = ") + 10));
  EXPECT_NEAR(delay_s, 0.25 + kLightLate_s, 0.001);
}

TEST_F(DelayByLight, AnotherPeriodIsRefused) {
  const std::string why = refusal({.period_s = 0.31, .lit_s = 0.1});
  EXPECT_NE(why.find("does not follow a period of 0.31 s"), std::string::npos) << why;
}

TEST_F(DelayByLight, TwoKindsOfTimesAreRefused) {
  film("camera");
  const std::string why = refusal(kSeventh);
  EXPECT_NE(why.find("some times are by arrivals"), std::string::npos) << why;
}

}  // namespace
}  // namespace ols::calibration
