#include <gtest/gtest.h>

#include "base/config_section.h"
#include "edge/recorder/recorder.h"

namespace ols::recorder {
namespace {

RecorderConfig read(const std::string& text) {
  ConfigFile file("[recorder]\n" + text, "station.toml");
  RecorderConfig config;
  config::read(recorder_section(config), file.root().table("recorder"));
  return config;
}

TEST(RecorderConfig, OnlyTheFolderIsNeeded) {
  const RecorderConfig config = read("folder = '/data'");
  EXPECT_EQ(config.folder, "/data");
  EXPECT_EQ(config.memory_s, RecorderConfig{}.memory_s);
  EXPECT_EQ(config.quota_bytes, RecorderConfig{}.quota_bytes);
  EXPECT_THROW(read("memory_s = 1.0"), ConfigError) << "a section that records nothing is a slip";
}

TEST(RecorderConfig, SizesAreReadInTheUnitOfTheirKey) {
  const RecorderConfig config =
      read("folder = '/data'\nmemory_max_mb = 2.0\nquota_gb = 3.0\ndisk_reserve_gb = 0.5");
  EXPECT_EQ(config.memory_max_bytes, 2e6);
  EXPECT_EQ(config.quota_bytes, 3e9);
  EXPECT_EQ(config.disk_reserve_bytes, 0.5e9);
}

TEST(RecorderConfig, OldEventsAreProtectedForAMinuteAtLeast) {
  EXPECT_EQ(read("folder = '/data'\nprotect_s = 60.0").protect_s, 60.0);
  EXPECT_THROW(read("folder = '/data'\nprotect_s = 59.0"), ConfigError);
}

}  // namespace
}  // namespace ols::recorder
