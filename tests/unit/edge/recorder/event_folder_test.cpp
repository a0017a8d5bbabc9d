#include "edge/recorder/event_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>
#include <utility>

#include "tests/unit/edge/recorder/recorder_files.h"

namespace ols::recorder {
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
            "utime_us,number,file,mid_exposure_sd_s,pixel_format,stamp_source\n"
            "1700000001500000,7,1700000001500000.png,0.000010000,Mono8,camera\n");
  const cv::Mat read = cv::imread(store / "e/1700000001500000.png", cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.size(), frame.picture.size());
  EXPECT_EQ(cv::norm(read, frame.picture, cv::NORM_L1), 0.0);
}

// Colours, mosaics and twelve bits come back as the camera sent them.
TEST(EventFolder, PicturesOfEveryKindAreWithoutLoss) {
  for (const auto& [format, type] : {std::pair("BayerRG8", CV_8UC1),
                                     {"Mono16", CV_16UC1},
                                     {"BGR8", CV_8UC3},
                                     {"RGB8", CV_8UC3}}) {
    RecordedFrame frame = noisy_frame(3, 1.0);
    frame.pixel_format = format;
    frame.picture = cv::Mat(32, 32, type);
    cv::RNG(9).fill(frame.picture, cv::RNG::UNIFORM, 0, 4096);
    cv::Mat read = cv::imdecode(encode_png(frame), cv::IMREAD_UNCHANGED);  // blue first
    if (frame.pixel_format == "RGB8") cv::cvtColor(read, read, cv::COLOR_BGR2RGB);
    ASSERT_EQ(read.type(), type) << format;
    EXPECT_EQ(cv::norm(read, frame.picture, cv::NORM_L1), 0.0) << format;
  }
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
  EXPECT_THAT([&] { EventFolder(store.path() + "/file", "e"); },
              testing::ThrowsMessage<std::system_error>(testing::HasSubstr("file/e.partial")));
}

TEST(EventFolder, WithoutAFrameNothingStays) {
  const TemporaryFolder store;
  EventFolder event(store.path(), "e");
  event.discard();
  EXPECT_THAT(names_in(store.path()), ElementsAre());
}

}  // namespace
}  // namespace ols::recorder
