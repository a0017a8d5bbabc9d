#include "edge/lens/lens_config.h"

#include <gtest/gtest.h>

#include "base/config/config_section.h"
#include "base/process/clocks.h"
#include "edge/lens/lens_motor.h"
#include "sim/lens/lens_line.h"
#include "tests/unit/error_text.h"
#include "tests/unit/eventually.h"

namespace ols::lens {
namespace {

LensMotorConfig read(const std::string& text) {
  LensMotorConfig config;
  ConfigFile file(text, "lens.toml");
  config::read({"", "", {}, {lens_motor_section(config)}}, file.root());
  return config;
}

std::string refusal(const std::string& text) {
  return error_text<ConfigError>([&] { static_cast<void>(read(text)); }, "taken");
}

std::string point(const char* position, const char* focal) {
  return std::string("[[lens_motor.point]]\nposition = ") + position + "\nfocal_px = " + focal +
         "\nfocal_sd_px = 2\ncx_px = 640\ncy_px = 480\ncentre_sd_px = 3\n";
}

const std::string kHead = "[lens_motor]\ndevice = \"/dev/ttyUSB3\"\n";

TEST(LensConfig, ReadsTheCalibrationOverTheZoom) {
  const LensMotorConfig config = read(kHead + point("0", "2000") + point("1", "20000"));
  EXPECT_EQ(config.device, "/dev/ttyUSB3");
  ASSERT_EQ(config.points.size(), 2U);
  EXPECT_EQ(config.points[1].camera.fx_px, 20000.0);
  EXPECT_EQ(config.points[1].camera.fy_px, 20000.0);
  EXPECT_EQ(config.points[1].focal_sd_px, 2.0);
}

TEST(LensConfig, ALensWithoutACalibrationIsRefusedInWords) {
  EXPECT_NE(refusal(kHead).find("needs at least two points"), std::string::npos);
  EXPECT_NE(refusal(kHead + point("1", "2000") + point("0", "20000")).find("positions must rise"),
            std::string::npos);
  EXPECT_EQ(refusal(""), "taken") << "no lens at all";
}

TEST(LensMotor, MovesTheLensOnItsLineAndReports) {
  const sim::LensLine line(sim::LensUnitConfig{.zoom_travel_s = 0.5});
  LensMotorConfig config;
  config.device = line.device();
  LensMotor motor(config);
  EXPECT_TRUE(eventually([&] { return motor.report().state == device::DeviceState::kOk; }));
  EXPECT_EQ(motor.report().text, "vendor 0020, model 0466, ROM 0105");
  LensOrder order;
  order.axes.zoom = AxisOrder{0.5, 0.0, 0.0};
  motor.order(order);
  EXPECT_TRUE(eventually([&] {
    const auto zoom = motor.positions().zoom;
    return zoom && std::abs(*zoom - 0.5) < 1e-3;
  }));
  EXPECT_NEAR(line.zoom_at(clock_monotonic_s()), 0.5, 1e-3);
  EXPECT_FALSE(motor.take_samples().empty());
  EXPECT_TRUE(motor.take_samples().size() < 10U) << "each once";
  EXPECT_GT(motor.report().counters.at("lens_replies"), 4U);
}

TEST(LensMotor, ADeviceThatIsNotThereIsAFaultAndTriedAgain) {
  LensMotorConfig config;
  config.device = "/nowhere/lens";
  const LensMotor motor(config);
  EXPECT_TRUE(eventually([&] { return motor.report().errors > 1; }));
  EXPECT_NE(motor.report().state, device::DeviceState::kOk);
  EXPECT_FALSE(motor.positions().zoom);
}

}  // namespace
}  // namespace ols::lens
