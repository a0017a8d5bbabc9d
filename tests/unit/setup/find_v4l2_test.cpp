#include "tools/setup/find_v4l2.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "tests/unit/setup/fake_v4l2.h"

namespace ols::setup {
namespace {

using camera::V4l2Format;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

TEST(FindV4l2, TheLargestPicturesThatAreFastEnoughAreTaken) {
  const V4l2Mode slow{V4l2Format::kRaw, 1920, 1080, 5.0};
  const V4l2Mode good{V4l2Format::kMjpeg, 1920, 1080, 30.0};
  const V4l2Mode too_fast{V4l2Format::kMjpeg, 1920, 1080, 60.0};
  const V4l2Mode huge{V4l2Format::kMjpeg, 3840, 2160, 30.0};
  const V4l2Mode small{V4l2Format::kRaw, 640, 480, 30.0};
  const auto best = [](const std::vector<V4l2Mode>& modes) { return best_mode(modes).value(); };
  EXPECT_EQ(best({slow, small, huge, too_fast, good}).frame_rate_hz, 30.0);
  EXPECT_EQ(best({slow, small, huge, too_fast, good}).width_px, 1920);
  EXPECT_EQ(best({huge, slow}).frame_rate_hz, 5.0);
  EXPECT_EQ(best({small, {V4l2Format::kMjpeg, 640, 480, 30.0}}).format, V4l2Format::kRaw);
  EXPECT_FALSE(best_mode({huge}));
  EXPECT_FALSE(best_mode({{V4l2Format::kRaw, 640, 480, 0.0}}));
  EXPECT_FALSE(best_mode({}));
}

fake::VideoDevice webcam() {
  return {"Web \x1b Cam",
          V4L2_CAP_VIDEO_CAPTURE,
          {{V4L2_PIX_FMT_YUYV, 640, 480, 30},
           {V4L2_PIX_FMT_YUYV, 1280, 720, 10},
           {V4L2_PIX_FMT_MJPEG, 1280, 720, 60},
           {V4L2_PIX_FMT_MJPEG, 1280, 720, 25},
           {V4L2_PIX_FMT_H264, 1920, 1080, 30}}};
}

TEST(FindV4l2, ADriversAnswersBecomeTheKeysOfACamera) {
  const fake::VideoDriver driver(webcam());
  const auto found = find_v4l2({"/dev/null", "/nonexistent/video0"});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].words, "Web ? Cam at /dev/null: 1280 x 720, 25 Hz");
  for (const auto& [key, value] : {std::pair{"kind", "\"v4l2\""},
                                   {"device", "\"/dev/null\""},
                                   {"format", "\"mjpeg\""},
                                   {"width_px", "1280"},
                                   {"height_px", "720"},
                                   {"frame_rate_hz", "25"}})
    EXPECT_THAT(found[0].values, Contains(Pair("station.camera." + std::string(key), value)));
}

TEST(FindV4l2, ADriverThatScalesGivesItsGreatestSize) {
  fake::VideoDevice scales = webcam();
  scales.is_stepwise = true;
  scales.modes = {{V4L2_PIX_FMT_YUYV, 4096, 3072, 25}};
  const fake::VideoDriver driver(scales);
  EXPECT_EQ(find_v4l2({"/dev/null"}).at(0).words, "Web ? Cam at /dev/null: 1920 x 1080, 25 Hz");
}

TEST(FindV4l2, WhatIsNoCameraIsNotFound) {
  EXPECT_THAT(find_v4l2({"/dev/null"}), IsEmpty()) << "no video device";
  fake::VideoDevice other = webcam();
  other.capabilities = V4L2_CAP_META_CAPTURE;
  {
    const fake::VideoDriver driver(other);
    EXPECT_THAT(find_v4l2({"/dev/null"}), IsEmpty()) << "a camera's second device";
  }
  other = webcam();
  other.modes = {{V4L2_PIX_FMT_H264, 1920, 1080, 30}};
  const fake::VideoDriver driver(other);
  EXPECT_THAT(find_v4l2({"/dev/null"}), IsEmpty()) << "no pictures that a station can use";
}

}  // namespace
}  // namespace ols::setup
