#include "edge/lens/lens_config.h"

#include <gtest/gtest.h>

#include "base/config/config_section.h"
#include "tests/unit/error_text.h"

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

}  // namespace
}  // namespace ols::lens
