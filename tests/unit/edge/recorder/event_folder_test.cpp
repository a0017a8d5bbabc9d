#include "edge/recorder/event_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "tests/unit/edge/recorder/temporary_folder.h"

namespace ols {
namespace {

using testing::ElementsAre;

TEST(EventFolder, HasFramesAndTableAndAppearsWhole) {
  const TemporaryFolder store;
  EventFolder event(store.path(), "e");
  const RecordedFrame frame = noisy_frame(7, 1.5);
  event.write(frame, encode_png(frame));
  EXPECT_THAT(names_in(store.path()), ElementsAre("e.partial"));
  event.finish();
  EXPECT_THAT(names_in(store.path()), ElementsAre("e"));
  EXPECT_THAT(names_in(store / "e"), ElementsAre("1700000001500000.png", "frames.csv"));
  EXPECT_EQ(content_of(store / "e/frames.csv"),
            "utime_us,number,file,mid_exposure_sd_s\n"
            "1700000001500000,7,1700000001500000.png,0.000010000\n");
  const cv::Mat read =
      cv::imread((store / "e/1700000001500000.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.size(), frame.gray.size());
  EXPECT_EQ(cv::norm(read, frame.gray, cv::NORM_L1), 0.0);
}

TEST(EventFolder, TwoFramesOfTheSameTimeAreBothKept) {
  const TemporaryFolder store;
  EventFolder event(store.path(), "e");
  const RecordedFrame first = noisy_frame(1, 1.0), second = noisy_frame(2, 1.0);
  event.write(first, encode_png(first));
  event.write(second, encode_png(second));
  event.finish();
  EXPECT_THAT(names_in(store / "e"),
              ElementsAre("1700000001000000.png", "1700000001000000_2.png", "frames.csv"));
}

TEST(EventFolder, AFolderThatIsNoneIsNamed) {
  const TemporaryFolder store;
  std::ofstream(store / "file") << "x";
  try {
    EventFolder(store.path() + "/file", "e");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("file/e.partial"));
  }
}

TEST(EventFolder, WithoutAFrameNothingStays) {
  const TemporaryFolder store;
  EventFolder event(store.path(), "e");
  event.discard();
  EXPECT_THAT(names_in(store.path()), ElementsAre());
}

}  // namespace
}  // namespace ols
