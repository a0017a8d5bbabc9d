#include "tools/calibrate/awaited_picture.h"

#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

constexpr std::int64_t kBoot = 7;
constexpr PanTilt kAt{0.5, 0.1};

ols_msg::frame_part_t part(std::int64_t request, std::int64_t utime, int number, int parts) {
  ols_msg::frame_part_t message{};
  message.request_boot_id = kBoot;
  message.request_sequence = request;
  message.utime = utime;
  message.part = static_cast<std::int16_t>(number);
  message.parts = static_cast<std::int16_t>(parts);
  message.data = {static_cast<std::uint8_t>(number)};
  return message;
}

class AwaitedPictureTest : public testing::Test {
 protected:
  void SetUp() override { awaited.asked(10); }
  AwaitedPicture awaited{kBoot, kAt, 100.0};
};

TEST_F(AwaitedPictureTest, ItsPartsInAnyOrderMakeTheFile) {
  EXPECT_FALSE(awaited.hear_part(part(10, 1000, 2, 3), 101.0));
  EXPECT_FALSE(awaited.hear_part(part(10, 1000, 0, 3), 102.0));
  EXPECT_EQ(awaited.hear_part(part(10, 1000, 1, 3), 103.0), (std::vector<std::uint8_t>{0, 1, 2}));
}

TEST_F(AwaitedPictureTest, AFrameOnItsWayCountsAfterItWasAskedForAgain) {
  awaited.hear_part(part(10, 1000, 0, 2), 101.0);
  awaited.asked(11);
  EXPECT_TRUE(awaited.hear_part(part(10, 1000, 1, 2), 105.0));
}

TEST_F(AwaitedPictureTest, APartThatWasLostCostsTheFrameButNotTheNext) {
  awaited.hear_part(part(10, 1000, 0, 2), 101.0);
  awaited.asked(11);
  EXPECT_FALSE(awaited.hear_part(part(11, 2000, 1, 2), 105.0));
  EXPECT_FALSE(awaited.hear_part(part(10, 1000, 1, 2), 105.1));  // of the older frame
  EXPECT_TRUE(awaited.hear_part(part(11, 2000, 0, 2), 105.2));
}

TEST_F(AwaitedPictureTest, PartsForOthersAndOfEarlierPicturesAreDropped) {
  EXPECT_FALSE(awaited.hear_part(part(9, 1000, 0, 1), 101.0));
  auto other = part(10, 1000, 0, 1);
  other.request_boot_id = kBoot + 1;
  EXPECT_FALSE(awaited.hear_part(other, 101.0));
  for (const int number : {-1, 1}) EXPECT_FALSE(awaited.hear_part(part(10, 1, number, 1), 101.0));
  EXPECT_FALSE(awaited.hear_part(part(10, 1000, 0, 1001), 101.0));
  EXPECT_EQ(awaited.progress_s(), 100.0);
}

TEST_F(AwaitedPictureTest, AUnitThatComesNearerIsProgressAndOneThatStandsIsNot) {
  awaited.hear_angles({0.0, 0.0}, 101.0);
  awaited.hear_angles({0.2, 0.0}, 102.0);
  EXPECT_EQ(awaited.progress_s(), 102.0);
  awaited.hear_angles({0.2, 0.0}, 103.0);
  awaited.hear_angles({0.1, 0.0}, 104.0);  // away again
  EXPECT_EQ(awaited.progress_s(), 102.0);
  awaited.hear_angles({0.3, 0.1}, 105.0);
  EXPECT_EQ(awaited.progress_s(), 105.0);
}

TEST_F(AwaitedPictureTest, MoreOfAPictureThanEverBeforeIsProgress) {
  awaited.hear_part(part(10, 1000, 0, 3), 101.0);
  awaited.hear_part(part(10, 1000, 0, 3), 102.0);  // the same again
  EXPECT_EQ(awaited.progress_s(), 101.0);
  EXPECT_EQ(awaited.part_heard_s(), 101.0);
  awaited.hear_part(part(10, 2000, 1, 3), 103.0);  // of another frame: no more than there was
  EXPECT_EQ(awaited.progress_s(), 101.0);
  EXPECT_EQ(awaited.part_heard_s(), 103.0);
  awaited.hear_part(part(10, 2000, 0, 3), 104.0);
  EXPECT_EQ(awaited.progress_s(), 104.0);
}

TEST_F(AwaitedPictureTest, SaysWhatIsMissing) {
  EXPECT_NE(awaited.missing().find("angles are not known"), std::string::npos);
  awaited.hear_angles({0.0, 0.1}, 101.0);
  EXPECT_NE(awaited.missing().find("did not arrive at pan 28.65"), std::string::npos);
  awaited.hear_angles(kAt, 102.0);
  EXPECT_NE(awaited.missing().find("no picture"), std::string::npos);
  awaited.hear_part(part(10, 1000, 0, 3), 103.0);
  EXPECT_NE(awaited.missing().find("1 of 3 parts"), std::string::npos);
}

}  // namespace
}  // namespace ols::calibration
