#include "edge/calibration/calibration_supervisor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "calibration/procedure/sun_keep_out.h"
#include "geometry/angles.h"
#include "tests/unit/edge/calibration/calibration_files.h"
#include "tests/unit/eventually.h"

namespace ols::station {
namespace {

class CalibrationSupervisorTest : public testing::Test {
 protected:
  StationSettings configured() const {
    StationSettings settings = test::settings();
    settings.calibration_folder = files_.path;
    return settings;
  }
  // Whether the unit is moved within so many seconds.
  static bool moves(CalibrationSupervisor& kept, double seconds) {
    kept.set_limits(travel());
    for (double now_s = 0.0; now_s < seconds; now_s += 1.0) {
      if (kept.step({now_s, true, PanTilt{}})) return true;
    }
    return false;
  }
  // Of one round; none is looked at where the sun stands.
  static std::size_t views_seen(const StationSettings& settings,
                                const CalibrationSupervisor::UtcNow& now,
                                const calibration::SunKeepOut& sun) {
    CalibrationSupervisor kept(settings, now);
    kept.set_limits(travel());
    PanTilt at;
    std::set<long> pans;
    for (double now_s = 0.0; now_s < 60.0; now_s += 0.5) {
      const auto goal = kept.step({now_s, true, at});
      if (!goal) continue;
      at = goal->angles;
      EXPECT_EQ(sun.hindrance(at), "");
      pans.insert(std::lround(std::floor(degrees(at.pan_rad) / 60.0)));
      camera::Frame frame;
      frame.mid_exposure_s = now_s;
      frame.gray = cv::Mat::zeros(48, 64, CV_8U);
      kept.see(frame);
    }
    return pans.size();
  }
  static mount::Limits travel() {
    mount::Limits limits;
    limits.count = {5.61e-5, 5.61e-5};
    return limits;
  }
  test::CalibrationFolder files_{"calibration_supervisor"};
};

// The sun rises in one of the views, and no filter is on the lens.
TEST_F(CalibrationSupervisorTest, WhereTheSunStandsItDoesNotLook) {
  const StationSettings settings = configured();
  const StationModel model = read_calibration(files_.path, settings).calibration.model;
  std::int64_t utime_us = 1'773'964'800'000'000;  // 2026-03-20, midnight
  const auto now = [&utime_us] { return utime_us; };
  const calibration::SunKeepOut sun(model, now);
  EXPECT_EQ(views_seen(settings, now, sun), 4U) << "at night";
  // One of the views is at azimuth 78.
  const auto kept_out = [&](double azimuth_deg) {
    const auto there = aim_along(model.geometry, {radians(azimuth_deg), radians(2.0)});
    return !sun.hindrance(*there).empty();
  };
  while (!kept_out(75.0) || !kept_out(82.0)) utime_us += 600'000'000;
  EXPECT_EQ(views_seen(settings, now, sun), 3U) << "soon after sunrise";
}

TEST_F(CalibrationSupervisorTest, AStationWithoutOneNeverMovesByItself) {
  CalibrationSupervisor none(test::settings());
  EXPECT_FALSE(moves(none, 5000.0));
  EXPECT_TRUE(none.alarms().empty());
  EXPECT_TRUE(none.counters().empty());
  EXPECT_FALSE(none.take_doubt());
}

TEST_F(CalibrationSupervisorTest, OneWithAFolderStoresItsViewsFirst) {
  CalibrationSupervisor kept(configured());
  EXPECT_EQ(kept.status().state, CalibrationState::kInUse);
  EXPECT_TRUE(moves(kept, 60.0));
  EXPECT_EQ(kept.counters().at("view_checks"), 0.0);
}

TEST_F(CalibrationSupervisorTest, ChecksCanBeSwitchedOff) {
  StationSettings settings = configured();
  settings.view_check_s = 0.0;
  CalibrationSupervisor kept(settings);
  EXPECT_FALSE(moves(kept, 5000.0));
  EXPECT_EQ(kept.status().state, CalibrationState::kInUse);
}

TEST_F(CalibrationSupervisorTest, ARefusedOneIsCheckedNoMore) {
  CalibrationSupervisor kept(configured());
  device::DeviceReport camera;
  camera.name = "camera";
  camera.serial = "another";
  EXPECT_TRUE(kept.refuses({camera}));
  EXPECT_EQ(kept.status().state, CalibrationState::kRefused);
  EXPECT_FALSE(moves(kept, 5000.0));
}

TEST_F(CalibrationSupervisorTest, OneOfAnotherStepModeIsCheckedNoMore) {
  CalibrationSupervisor kept(configured());
  EXPECT_TRUE(kept.refuses(PanTilt{1e-4, 1e-4}));
  EXPECT_EQ(kept.status().state, CalibrationState::kRefused);
  EXPECT_FALSE(moves(kept, 5000.0));
}

TEST_F(CalibrationSupervisorTest, ADoubtedOneStatesTheDoubt) {
  StationSettings settings = configured();
  const CalibrationStatus before = CalibrationSupervisor(settings).status();
  settings.state_folder = files_.path;
  const int red = static_cast<int>(DriftLevel::kRed),
            tripod = static_cast<int>(DriftCause::kTripod);
  files_.put("alfa.drift", "drift 1 " + std::to_string(before.id) + " " + std::to_string(red) +
                               " " + std::to_string(tripod) + " 0.003 0.001 0 0 0 0 0 0\n");
  const CalibrationStatus doubted = CalibrationSupervisor(settings).status();
  EXPECT_EQ(doubted.state, CalibrationState::kDoubted);
  EXPECT_NEAR(doubted.rms_rad, std::hypot(before.rms_rad, 0.003), 1e-12);
}

class AcceptedMeanwhile : public CalibrationSupervisorTest {
 protected:
  AcceptedMeanwhile() {
    second_.setup = std::string(test::kSetup) + "# another\n";
    second_.write();
    link(files_.path);
    settings_ = test::settings();
    settings_.calibration_folder = link_;
    id_ = read_calibration(second_.path, settings_).id;
  }
  ~AcceptedMeanwhile() override { std::filesystem::remove(link_); }
  void link(const std::string& folder) const {
    std::filesystem::create_directory_symlink(folder, link_ + ".next");
    std::filesystem::rename(link_ + ".next", link_);
  }
  static device::DeviceReport camera(const std::string& serial) {
    device::DeviceReport report;
    report.name = "camera";
    report.serial = serial;
    return report;
  }
  // A station at work, until its thread has read; true: it was taken up.
  bool waits(CalibrationSupervisor& kept, const std::string& serial) {
    bool taken = false;
    eventually([&] {
      taken = kept.adopts(now_s_ += 1.5, false, {camera(serial)}, {}) || taken;
      return !kept.alarms().empty();
    });
    return taken;
  }

  test::CalibrationFolder second_{"kept_calibration_2_"};
  std::string link_ = (std::filesystem::temp_directory_path() /
                       ("kept_calibration_link_" + std::to_string(::getpid())))
                          .string();
  StationSettings settings_;
  std::int64_t id_ = 0;
  double now_s_ = 100.0;
};

TEST_F(AcceptedMeanwhile, IsTakenUpOnceTheStationIsIdle) {
  CalibrationSupervisor kept(settings_);
  const auto before = kept.status().id;
  link(second_.path);
  EXPECT_FALSE(waits(kept, "C7")) << "at work";
  EXPECT_EQ(kept.status().id, before);
  EXPECT_NE(kept.alarms().front().text.find("accepted, not yet in use"), std::string::npos);
  EXPECT_TRUE(kept.adopts(now_s_ += 1.5, true, {camera("C7")}, {}));
  EXPECT_EQ(kept.status().id, id_);
  EXPECT_EQ(kept.settings().calibration_id, id_);
  EXPECT_TRUE(kept.alarms().empty());
  EXPECT_FALSE(kept.adopts(now_s_ += 1.5, true, {camera("C7")}, {})) << "once";
}

TEST_F(AcceptedMeanwhile, OneOfAnotherCameraIsNotAndTheOldOneStands) {
  CalibrationSupervisor kept(settings_);
  const auto before = kept.status().id;
  link(second_.path);
  EXPECT_FALSE(waits(kept, "C8"));
  EXPECT_FALSE(kept.adopts(now_s_ += 1.5, true, {camera("C8")}, {}));
  EXPECT_EQ(kept.status().id, before);
  EXPECT_NE(kept.alarms().front().text.find("the camera says 'C8'"), std::string::npos);
}

TEST_F(AcceptedMeanwhile, EndsARefusal) {
  CalibrationSupervisor kept(settings_);
  ASSERT_TRUE(kept.refuses({camera("C8")}));
  link(second_.path);
  EXPECT_FALSE(waits(kept, "C7"));
  EXPECT_TRUE([&] {
    bool taken = false;
    eventually([&] {
      taken = taken || kept.adopts(now_s_ += 1.5, true, {camera("C7")}, {});
      return taken;
    });
    return taken;
  }());
  EXPECT_EQ(kept.status().state, CalibrationState::kInUse);
  EXPECT_TRUE(kept.alarms().empty());
}

}  // namespace
}  // namespace ols::station
