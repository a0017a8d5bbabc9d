#include "tools/calibrate/reference_feed.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/temporary_folder.h"

namespace ols::calibration {
namespace {

constexpr const char* kHead =
    "landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us\n"
    "spire,49.2266,16.5969,310.0,0.02,\n"
    "drone,49.227,16.5971,361.2,0.02,1780000000000000\n"
    "drone,49.227,16.5972,361.2,0.02,1780000001000000\n";

class ReferenceFeedTest : public testing::Test {
 protected:
  ReferenceFeedTest() { append(kHead); }
  void append(const std::string& text) { std::ofstream(source_, std::ios::app) << text; }
  std::size_t points(const ReferenceFeed& feed) const {
    return feed.trajectory("drone").points.size();
  }
  TemporaryFolder folder_;
  const std::string source_ = folder_ / "flight.csv", copy_ = folder_ / "references.csv";
};

TEST_F(ReferenceFeedTest, LinesThatAreAppendedAreTakenWhenTheyAreWhole) {
  ReferenceFeed feed(source_, copy_);
  ASSERT_EQ(feed.landmarks().size(), 1U);
  EXPECT_EQ(feed.landmarks()[0].name, "spire");
  EXPECT_EQ(points(feed), 2U);
  append("drone,49.227,16.5973,361.2,0.02,17800000020");
  feed.refresh();
  EXPECT_EQ(points(feed), 2U) << "half a line";
  append("00000\n");
  feed.refresh();
  EXPECT_EQ(points(feed), 3U);
  EXPECT_EQ(ReferenceFeed(copy_, folder_ / "again.csv").references().size(), 2U) << "the copy";
  EXPECT_TRUE(feed.trajectory("nobody").points.empty());
}

TEST_F(ReferenceFeedTest, ASourceThatIsDamagedLaterLeavesWhatThereWas) {
  ReferenceFeed feed(source_, copy_);
  append("drone,north,16.5973,361.2,0.02,1780000002000000\n");
  feed.refresh();
  EXPECT_EQ(points(feed), 2U);
  EXPECT_NE(feed.trouble().find(":5"), std::string::npos) << feed.trouble();
  std::filesystem::remove(source_);
  feed.refresh();
  EXPECT_EQ(points(feed), 2U);
  EXPECT_FALSE(feed.trouble().empty());
}

TEST_F(ReferenceFeedTest, OneThatIsDamagedFromTheBeginningIsRefused) {
  append("drone,north,16.5973,361.2,0.02,1780000002000000\n");
  EXPECT_THROW(ReferenceFeed(source_, copy_), std::exception);
}

}  // namespace
}  // namespace ols::calibration
