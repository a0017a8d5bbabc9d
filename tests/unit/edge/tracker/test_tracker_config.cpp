#include <gtest/gtest.h>

#include "base/toml_config.h"
#include "edge/tracker/tracker_config.h"

namespace ols {
namespace {

TEST(TrackerConfig, IsReadStrictly) {
  ConfigFile file("[tracker]\nparticles = 500\nsharpness = 9.5\n", "t.toml");
  const TrackerConfig config = read_tracker_config(file.root().table("tracker"));
  EXPECT_EQ(config.particles, 500);
  EXPECT_EQ(config.sharpness, 9.5);
  EXPECT_NO_THROW(file.finish());
  ConfigFile few("[tracker]\nparticles = 3\n", "t.toml");
  EXPECT_THROW(read_tracker_config(few.root().table("tracker")), ConfigError);
  ConfigFile unknown("[tracker]\nparticle = 300\n", "t.toml");
  read_tracker_config(unknown.root().table("tracker"));
  EXPECT_THROW(unknown.finish(), ConfigError);
}

TEST(TrackerConfig, ChoosesTheMode) {
  ConfigFile file("[tracker]\nmode = \"paper\"\n[tracker.paper]\nsize_sd_px = 0.5\n", "t.toml");
  const TrackerConfig config = read_tracker_config(file.root().table("tracker"));
  file.finish();
  EXPECT_EQ(config.mode, TrackerMode::kPaper);
  EXPECT_EQ(config.paper.size_sd_px, 0.5);
  ConfigFile wrong("[tracker]\nmode = \"fast\"\n", "t.toml");
  EXPECT_THROW(read_tracker_config(wrong.root().table("tracker")), ConfigError);
}

}  // namespace
}  // namespace ols
