#include "tools/offline/tracker_setup.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "base/config/toml_config.h"
#include "tests/unit/temp_dir.h"

namespace ols::offline {
namespace {

using tracker::TrackerMode;

class TrackerSetupTest : public testing::Test {
 protected:
  void file_has(const std::string& text) const { std::ofstream(path_) << text; }
  ~TrackerSetupTest() override { std::remove(path_.c_str()); }
  const std::string path_ =
      temp_dir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
};

TEST_F(TrackerSetupTest, TheCommandLineOverridesTheFile) {
  file_has("[tracker]\nmode = \"paper\"\n");
  EXPECT_EQ(load_tracker_config(path_, "").mode, TrackerMode::kPaper);
  EXPECT_EQ(load_tracker_config(path_, "full").mode, TrackerMode::kFull);
  EXPECT_EQ(load_tracker_config("", "paper").mode, TrackerMode::kPaper);
}

TEST_F(TrackerSetupTest, WithoutAFileTheDefaultsHold) {
  EXPECT_EQ(load_tracker_config("", "").mode, tracker::TrackerConfig{}.mode);
}

TEST_F(TrackerSetupTest, AMisspeltKeyIsAnError) {
  file_has("[tracker]\nmoode = \"paper\"\n");
  EXPECT_THROW(load_tracker_config(path_, ""), ConfigError);
}

}  // namespace
}  // namespace ols::offline
