#include "edge/ptu/ptu_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/config_section.h"
#include "geometry/angles.h"

namespace ols::ptu {
namespace {

PtuConfig read(const std::string& text) {
  ConfigFile file("[ptu]\n" + text, "station.toml");
  PtuConfig config;
  config::read(ptu_section(config), file.root().table("ptu"));
  return config;
}

TEST(PtuConfigFile, ReadsDegreesAndKeepsDefaults) {
  const PtuConfig config = read(
      "device = '/dev/ttyUSB0'\nbaud = 38400\nacceleration_deg_s2 = 60\ntilt_max_deg = 20\n"
      "[ptu.servo]\nmax_speed_deg_s = 30\n");
  EXPECT_EQ(config.device, "/dev/ttyUSB0");
  EXPECT_EQ(config.baud, 38400);
  EXPECT_NEAR(config.acceleration_rad_s2, radians(60.0), 1e-12);
  EXPECT_NEAR(config.limits.tilt_max_rad, radians(20.0), 1e-12);
  EXPECT_NEAR(config.servo.max_speed_rad_s, radians(30.0), 1e-12);
  EXPECT_EQ(config.history.acceleration_max_rad_s2, config.acceleration_rad_s2);
  EXPECT_NEAR(config.history.acceleration_sd_rad_s2, radians(2.4), 1e-12);
  EXPECT_NEAR(config.limits.pan_min_rad, mount::Limits{}.pan_min_rad, 1e-12);
  EXPECT_EQ(config.poll_interval_s, PtuConfig{}.poll_interval_s);
}

TEST(PtuConfigFile, ReadsModesAndRegions) {
  const PtuConfig config = read(
      "device = 'x'\nbaud = 9600\npoll_interval_s = 0.08\nstep_mode = 'quarter'\n"
      "hold_power = 'low'\nmove_power = 'high'\n"
      "[[ptu.keep_out]]\npan_min_deg = 10\npan_max_deg = 20\ntilt_min_deg = -47\ntilt_max_deg = 5\n"
      "[[ptu.keep_out]]\npan_min_deg = -90\npan_max_deg = -80\ntilt_min_deg = 0\n"
      "tilt_max_deg = 31\n");
  EXPECT_EQ(config.step_mode, 'Q');
  EXPECT_EQ(config.hold_power, 'L');
  EXPECT_EQ(config.move_power, 'H');
  EXPECT_EQ(config.rehome, PtuRehome::kNever);
  EXPECT_TRUE(config.homes_at_power_up);
  EXPECT_FALSE(read("device = 'x'\nhomes_at_power_up = false\n").homes_at_power_up);
  ASSERT_EQ(config.limits.keep_out.size(), 2u);
  EXPECT_NEAR(config.limits.keep_out[0].tilt_min_rad, radians(-47.0), 1e-12);
  EXPECT_NEAR(config.limits.keep_out[1].pan_max_rad, radians(-80.0), 1e-12);
  EXPECT_EQ(read("device = 'x'\nrehome = 'when-unreferenced'\n").rehome,
            PtuRehome::kWhenUnreferenced);
  EXPECT_FALSE(config.home_despite_keep_out);
  EXPECT_TRUE(read("device = 'x'\nhome_despite_keep_out = true\n").home_despite_keep_out);
}

TEST(PtuConfigFile, RefusesWhatContradictsItself) {
  const auto refused = [](const std::string& text, const std::string& key) {
    try {
      read(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("station.toml"));
      EXPECT_THAT(error.what(), testing::HasSubstr(key));
    }
  };
  refused("device = ''\n", "device");
  refused("device = 'x'\npan_min_deg = 10\npan_max_deg = 5\n", "pan_max_deg");
  refused("device = 'x'\npan_min_deg = 10\npan_max_deg = 10\n", "pan_max_deg");
  refused("device = 'x'\ntilt_min_deg = 10\ntilt_max_deg = 10\n", "tilt_max_deg");
  refused("device = 'x'\ntilt_min_deg = 10\ntilt_max_deg = 5\n", "tilt_max_deg");
  refused("device = 'x'\ntilt_min_deg = 60\n", "tilt_max_deg");  // beyond the default
  refused("device = 'x'\nbaud = 9600\npoll_interval_s = 0.025\n",
          "9600 baud carry a poll in 0.074 s");
  refused("device = 'x'\nreply_timeout_s = 0.06\n", "reply_timeout_s");
  refused("device = 'x'\n[ptu.servo]\nlook_ahead_s = 0.8\n", "run on for 1.1");
  refused("device = 'x'\nacceleration_deg_s2 = 20\n", "look_ahead_s");
  const std::string region =
      "[[ptu.keep_out]]\npan_min_deg = 1\npan_max_deg = 2\ntilt_min_deg = -3\n";
  refused("device = 'x'\n" + region, "ptu.keep_out[0].tilt_max_deg");
  refused("device = 'x'\n" + region + "tilt_max_deg = -4\n", "ptu.keep_out[0].tilt_max_deg");
  refused("device = 'x'\nrehome = 'when-unreferenced'\n" + region + "tilt_max_deg = 4\n", "rehome");
}

}  // namespace
}  // namespace ols::ptu
