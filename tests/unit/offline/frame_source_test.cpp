#include "tools/offline/frame_source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "tests/unit/temp_dir.h"

namespace ols::offline {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 60;

fs::path clip_of(const std::string& name) {
  const fs::path file = fs::path(temp_dir()) / ("frame_source_test_" + name);
  const int code = cv::VideoWriter::fourcc('m', 'p', '4', 'v');
  cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, code, 30.0, {320, 240});
  for (int frame = 0; writer.isOpened() && frame < kFrames; ++frame) {
    cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(90, 90, 90));
    cv::rectangle(picture, {60 + 2 * frame, 50 + frame, 12, 12}, cv::Scalar::all(230), -1);
    writer.write(picture);
  }
  return file;
}

// A transport stream keeps neither the rate nor the number of its frames: a reader that takes the
// clock's 90 kHz for the rate makes thousands of frames of two seconds.
TEST(FrameSource, ReadsAClipThatDoesNotTellItsRateToTheEnd) {
  for (const std::string name : {"a.ts", "a.mp4"}) {
    const fs::path clip = clip_of(name);
    FrameSource source(clip.string());
    int read = 0;
    while (source.next()) ++read;
    EXPECT_NEAR(read, kFrames, 2) << name;
    EXPECT_EQ(source.frames_per_second(), 30.0) << name;
    fs::remove(clip);
  }
}

TEST(FrameSource, SaysAfterHowManyFramesADamagedClipEnds) {
  const fs::path clip = clip_of("cut.avi");
  fs::resize_file(clip, fs::file_size(clip) * 3 / 4);
  FrameSource source(clip.string());
  EXPECT_THROW(while (source.next()){}, FrameSourceError);
  fs::remove(clip);
}

}  // namespace
}  // namespace ols::offline
