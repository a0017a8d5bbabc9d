#include "edge/tracker/tracker_config.h"

#include <gtest/gtest.h>

#include "base/config/config_section.h"

namespace ols::tracker {
namespace {

TEST(TrackerConfig, IsReadStrictly) {
  ConfigFile file("[tracker]\nparticles = 500\nlearning_time_s = 0.7\n", "t.toml");
  TrackerConfig config;
  config::read(tracker_section(config), file.root().table("tracker"));
  EXPECT_EQ(config.particles, 500);
  EXPECT_EQ(config.learning_time_s, 0.7);
  ConfigFile few("[tracker]\nparticles = 3\n", "t.toml");
  EXPECT_THROW(config::read(tracker_section(config), few.root().table("tracker")), ConfigError);
  ConfigFile unknown("[tracker]\nparticle = 300\n", "t.toml");
  EXPECT_THROW(config::read(tracker_section(config), unknown.root().table("tracker")), ConfigError);
}

TEST(TrackerConfig, ChoosesTheMode) {
  ConfigFile file("[tracker]\nmode = \"paper\"\n", "t.toml");
  TrackerConfig config;
  config::read(tracker_section(config), file.root().table("tracker"));
  EXPECT_EQ(config.mode, TrackerMode::kPaper);
  ConfigFile wrong("[tracker]\nmode = \"fast\"\n", "t.toml");
  EXPECT_THROW(config::read(tracker_section(config), wrong.root().table("tracker")), ConfigError);
}

}  // namespace
}  // namespace ols::tracker
