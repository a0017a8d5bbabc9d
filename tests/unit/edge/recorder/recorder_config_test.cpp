#include <gtest/gtest.h>

#include <limits>

#include "edge/recorder/record_command.h"
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

constexpr double kNow_s = 1000.0;

class RecordCommandTest : public testing::Test {
 protected:
  RecordCommandTest() { config_.folder = "/somewhere"; }
  std::string wrong() const { return wrong_with(command_, config_, kNow_s); }
  RecorderConfig config_;
  RecordCommand command_{.event_s = kNow_s, .before_s = 5.0, .after_s = 5.0, .label = "drone-1_a"};
};

TEST_F(RecordCommandTest, AnOrdinaryCommandIsPermitted) { EXPECT_EQ(wrong(), ""); }

TEST_F(RecordCommandTest, NeedsARecorder) {
  config_.folder.clear();
  EXPECT_EQ(wrong(), "no recorder is configured");
}

// It becomes the name of a folder.
TEST_F(RecordCommandTest, ALabelCannotLeadOutOfTheFolder) {
  for (const char* label : {"../x", "a/b", "a b", ".", "a\n", "é"}) {
    command_.label = label;
    EXPECT_NE(wrong(), "") << label;
  }
  command_.label = std::string(40, 'a');
  EXPECT_EQ(wrong(), "");
  command_.label += 'a';
  EXPECT_NE(wrong(), "");
  command_.label.clear();
  EXPECT_EQ(wrong(), "") << "none is needed";
}

TEST_F(RecordCommandTest, TheDurationIsLimitedAndFinite) {
  command_.before_s = config_.event_max_s - command_.after_s;
  EXPECT_EQ(wrong(), "");
  command_.before_s += 0.1;
  EXPECT_NE(wrong(), "");
  for (const double s :
       {-0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    command_.before_s = s;
    EXPECT_NE(wrong(), "") << s;
    command_.before_s = 1.0;
    command_.after_s = s;
    EXPECT_NE(wrong(), "") << s;
    command_.after_s = 1.0;
  }
}

TEST_F(RecordCommandTest, AnEventIsNotInTheFuture) {
  command_.event_s = kNow_s + kLateFrame_s;
  EXPECT_EQ(wrong(), "");
  command_.event_s += 0.01;
  EXPECT_EQ(wrong(), "the event lies in the future");
  command_.event_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(wrong(), "");
}

TEST(RecordRate, AdmitsEightAtOnceAndThenOneEachTenSeconds) {
  RecordRate rate;
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(rate.admit(kNow_s)) << i;
  EXPECT_FALSE(rate.admit(kNow_s));
  EXPECT_FALSE(rate.admit(kNow_s + 9.0)) << "a refused request does not count";
  EXPECT_TRUE(rate.admit(kNow_s + 10.0));
  EXPECT_FALSE(rate.admit(kNow_s + 10.0));
  int admitted = 0;
  for (int i = 0; i < 100; ++i) admitted += rate.admit(kNow_s + 1e6) ? 1 : 0;
  EXPECT_EQ(admitted, 8) << "a long silence saves no more than that";
}

}  // namespace
}  // namespace ols::recorder
