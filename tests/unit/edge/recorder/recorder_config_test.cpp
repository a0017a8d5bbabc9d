#include <gtest/gtest.h>

#include "edge/recorder/recorder.h"
#include "tests/unit/base/config/section_text.h"

namespace ols::recorder {
namespace {

const test::SectionText<RecorderConfig> kSection{"recorder", recorder_section};

TEST(RecorderConfig, OnlyTheFolderIsNeeded) {
  const RecorderConfig config = kSection.read("folder = '/data'");
  EXPECT_EQ(config.folder, "/data");
  EXPECT_EQ(config.memory_s, RecorderConfig{}.memory_s);
  EXPECT_EQ(config.quota_bytes, RecorderConfig{}.quota_bytes);
  EXPECT_THROW(kSection.read("memory_s = 1.0"), ConfigError)
      << "a section that records nothing is a slip";
}

TEST(RecorderConfig, SizesAreReadInTheUnitOfTheirKey) {
  const RecorderConfig config =
      kSection.read("folder = '/data'\nmemory_max_mb = 2.0\nquota_gb = 3.0\ndisk_reserve_gb = 0.5");
  EXPECT_EQ(config.memory_max_bytes, 2e6);
  EXPECT_EQ(config.quota_bytes, 3e9);
  EXPECT_EQ(config.disk_reserve_bytes, 0.5e9);
}

TEST(RecorderConfig, OldEventsAreProtectedForAMinuteAtLeast) {
  EXPECT_EQ(kSection.read("folder = '/data'\nprotect_s = 60.0").protect_s, 60.0);
  EXPECT_THROW(kSection.read("folder = '/data'\nprotect_s = 59.0"), ConfigError);
}

}  // namespace
}  // namespace ols::recorder
