#include "edge/tracker/tracker_config.h"

#include <gtest/gtest.h>

#include "base/config/config_section.h"

namespace ols::tracker {
namespace {

TEST(TrackerConfig, EveryKeyArrives) {
  ConfigFile file("[tracker]\nparticles = 500\nlearning_time_s = 0.7\nmode = \"paper\"\n",
                  "t.toml");
  TrackerConfig config;
  config::read(tracker_section(config), file.root().table("tracker"));
  EXPECT_EQ(config.particles, 500);
  EXPECT_EQ(config.learning_time_s, 0.7);
  EXPECT_EQ(config.mode, TrackerMode::kPaper);
}

}  // namespace
}  // namespace ols::tracker
