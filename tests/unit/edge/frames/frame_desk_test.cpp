#include "edge/frames/frame_desk.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/unit/eventually.h"

namespace ols::station {
namespace {

TEST(FrameDesk, AFrameComesInPartsThatFitIntoDatagramsAndMakeItWhole) {
  constexpr double kCount_rad = 5.61e-5;
  FrameDesk desk;
  PointingModel unit{StationConfig{}};
  unit.set_limits({.count = {kCount_rad, kCount_rad}});
  FrameRequest request;
  request.boot_id = 4;
  request.expires_s = 100.0;
  EXPECT_EQ(desk.service().request(request), "");
  for (int i = 0; i < 4; ++i) {
    mount::AngleSample sample;
    sample.time_s = 0.025 * i;
    unit.add(sample);
  }
  camera::Frame frame;
  frame.gray = cv::Mat(480, 640, CV_8U);
  cv::randu(frame.gray, 0, 255);  // nothing to compress
  frame.mid_exposure_s = 0.03;
  desk.service().on_frame(frame);
  std::vector<std::uint8_t> file;
  std::optional<FramePart> part;
  ASSERT_TRUE(eventually([&] {
    desk.look({0.1, 1'000'000'000}, unit);
    return (part = desk.next()).has_value();
  }));
  const std::size_t parts = part->parts;
  EXPECT_GE(parts, 5U);
  for (std::size_t i = 0; i < parts; ++i) {
    ASSERT_TRUE(part);
    EXPECT_EQ(part->part, i);
    EXPECT_EQ(part->utime_us, 999'930'000) << "mid-exposure, although UTC was read again meanwhile";
    EXPECT_LE(part->bytes, FrameDesk::kPart_bytes);
    const auto first = part->frame->file.begin() + static_cast<std::ptrdiff_t>(part->first_byte);
    file.insert(file.end(), first, first + static_cast<std::ptrdiff_t>(part->bytes));
    if (i + 1 == parts) {
      EXPECT_EQ(file, part->frame->file);
    }
    desk.look({0.2, 1'000'100'007}, unit);
    part = desk.next();
  }
  EXPECT_FALSE(part);
}

// A bus that takes nothing: what is asked for must not pile up.
TEST(FrameDesk, HoldsNoMoreThanAFewFramesHoweverManyAreAskedFor) {
  constexpr double kCount_rad = 5.61e-5;
  FrameDesk desk;
  PointingModel unit{StationConfig{}};
  unit.set_limits({.count = {kCount_rad, kCount_rad}});
  camera::Frame frame;
  frame.gray = cv::Mat::zeros(8, 8, CV_8U);  // one part
  constexpr int kAsked = 2000;
  for (int i = 0; i < kAsked; ++i) {
    FrameRequest request;
    request.expires_s = 1e6;
    EXPECT_EQ(desk.service().request(request), "");
    mount::AngleSample sample;
    sample.time_s = 0.025 * i;
    unit.add(sample);
    frame.mid_exposure_s = sample.time_s - 0.01;
    desk.service().on_frame(frame);
    desk.look({}, unit);
    std::this_thread::yield();
  }
  int held = 0;
  EXPECT_TRUE(eventually([&] {
    desk.look({}, unit);
    for (; desk.next(); desk.look({}, unit)) ++held;
    return held >= 3;
  }));
  EXPECT_LE(held, 4) << "one in parts, three in the post";
}

}  // namespace
}  // namespace ols::station
