#include "edge/camera/aravis/aravis_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/config_section.h"
#include "tests/unit/error_text.h"

namespace ols::camera {
namespace {

AravisConfig read(std::string_view text) {
  ConfigFile file(text, "station.toml");
  AravisConfig config;
  config::read(aravis_section(config), file.root());
  return config;
}

std::string error_of(std::string_view text) {
  return error_text<ConfigError>([&] { read(text); });
}

constexpr const char* kEveryKey = R"(
device = "Prosilica-1234"
width_px = 640
height_px = 480
pixel_format = "BayerRG8"
frame_rate_hz = 30
exposure_us = 800.5
stamp_at = "exposure-end"
readout_s = 0.02
readout_sd_s = 0.003
packet_size = 8228
trigger = "line3"
trigger_activation = "falling-edge"
trigger_delay_us = 20
gain_dB = 3
auto_exposure = true
exposure_min_us = 60
exposure_max_us = 3000
gain_min_dB = 1
gain_max_dB = 18
auto_bright_level = 190
auto_mean_level = 100
auto_settle_frames = 6
ptp = "slave"
tai_minus_utc_s = 38
ptp_sd_s = 2e-6
packet_delay_us = 15
packet_spread = 0.5
packet_socket = true
socket_buffer = 1000000
packet_resend = false
)";

TEST(AravisConfig, ReadsEveryKeyOfPicturesAndTriggers) {
  const AravisConfig config = read(kEveryKey);
  EXPECT_EQ(config.width_px, 640);
  EXPECT_EQ(config.height_px, 480);
  EXPECT_EQ(config.pixel_format, "BayerRG8");
  EXPECT_DOUBLE_EQ(config.frame_rate_hz, 30.0);
  EXPECT_DOUBLE_EQ(config.exposure_us, 800.5);
  EXPECT_EQ(config.stamp_at, StampAt::kExposureEnd);
  EXPECT_DOUBLE_EQ(config.readout_s, 0.02);
  EXPECT_DOUBLE_EQ(config.readout_sd_s, 0.003);
  EXPECT_EQ(config.packet_size, 8228);
  EXPECT_EQ(config.trigger, TriggerMode::kLine3);
  EXPECT_EQ(config.trigger_activation, "falling-edge");
  EXPECT_DOUBLE_EQ(config.trigger_delay_us, 20.0);
}

TEST(AravisConfig, ReadsEveryKeyOfBrightnessClockAndTransport) {
  const AravisConfig config = read(kEveryKey);
  EXPECT_DOUBLE_EQ(config.gain_dB, 3.0);
  EXPECT_TRUE(config.auto_exposure);
  EXPECT_DOUBLE_EQ(config.limits.exposure_min_us, 60.0);
  EXPECT_DOUBLE_EQ(config.limits.exposure_max_us, 3000.0);
  EXPECT_DOUBLE_EQ(config.limits.gain_min_dB, 1.0);
  EXPECT_DOUBLE_EQ(config.limits.gain_max_dB, 18.0);
  EXPECT_DOUBLE_EQ(config.auto_levels.bright_level, 190.0);
  EXPECT_DOUBLE_EQ(config.auto_levels.mean_level, 100.0);
  EXPECT_EQ(config.auto_levels.settle_frames, 6);
  EXPECT_EQ(config.ptp, "slave");
  EXPECT_EQ(config.tai_minus_utc_s, 38);
  EXPECT_DOUBLE_EQ(config.ptp_sd_s, 2e-6);
  EXPECT_DOUBLE_EQ(config.packet_delay_us, 15.0);
  EXPECT_DOUBLE_EQ(config.packet_spread, 0.5);
  EXPECT_TRUE(config.packet_socket);
  EXPECT_EQ(config.socket_buffer, 1000000);
  EXPECT_FALSE(config.packet_resend);
}

// The ranges are in the reference of the configuration, which is compared with the tables.
TEST(AravisConfig, RefusesWhatContradictsItself) {
  using testing::HasSubstr;
  EXPECT_THAT(error_of("device = ''"), HasSubstr("device"));
  for (const char* bad : {"packet_size = 100", "packet_delay_us = -0.5", "exposure_max_us = 20",
                          "gain_max_dB = -1"}) {
    const std::string key(bad, std::string_view(bad).find(' '));
    EXPECT_THAT(error_of(std::string("device = 'x'\n") + bad), HasSubstr("station.toml:2: " + key));
  }
}

}  // namespace
}  // namespace ols::camera
