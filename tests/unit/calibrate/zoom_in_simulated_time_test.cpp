// The table of a zoom lens, measured by `ols-calibrate zoom` in simulated time, against the lens as
// it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/config_section.h"
#include "edge/lens/lens_config.h"
#include "tests/unit/calibrate/simulated_tripod.h"
#include "tools/calibrate/zoom_command.h"

namespace ols::calibration {
namespace {

using test::SimulatedTripod;

// The overview station alone.
sim::Scenario with_zoom() {
  sim::Scenario s = sim::load_scenario(std::string(OLS_SCENARIOS) + "/overview.toml");
  std::erase_if(s.stations, [](const auto& station) { return !station.overview; });
  s.stations.at(0).id = "alfa";
  s.frame_rate_hz = 6.0;
  s.inclinometer.on = s.gnss.on = s.gpio.on = false;
  return s;
}

std::vector<ZoomPoint> points_of(const std::string& path) {
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  lens::LensMotorConfig config;
  ConfigFile table("[lens_motor]\ndevice = \"/dev/null\"\n" + text, path);
  config::read({"", "", {}, {lens::lens_motor_section(config)}}, table.root());
  return config.points;
}

// The simulated scenery has no structure as fine as the longest end would need: there it must be
// said, and the other points stand.
TEST(ZoomInSimulatedTime, TheTableIsThatOfTheLens) {
  SimulatedTripod tripod(with_zoom());
  ZoomOptions options;
  options.station = tripod.config();
  options.state_folder = tripod.store();
  options.output = tripod.folder / "zoom.toml";
  options.positions = 3;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = run_zoom(options);
  const std::string said = testing::internal::GetCapturedStdout();
  const std::string complaints = testing::internal::GetCapturedStderr();
  const std::vector<ZoomPoint> points = points_of(options.output);
  ASSERT_GE(points.size(), 2U) << said << complaints;
  EXPECT_EQ(status, points.size() == 3 ? 0 : 1);
  EXPECT_EQ(complaints.find("too little of the scenery") != std::string::npos, points.size() < 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ZoomPoint& point = points[i];
    EXPECT_NEAR(point.position, 0.5 * static_cast<double>(i), 0.01);
    const double true_px = tripod.world.stations()[0].zoom->camera_at(point.position).fx_px;
    EXPECT_LT(point.focal_sd_px, 0.004 * true_px);
    EXPECT_NEAR(point.camera.fx_px, true_px, 3.5 * point.focal_sd_px) << said;
  }
}

}  // namespace
}  // namespace ols::calibration
