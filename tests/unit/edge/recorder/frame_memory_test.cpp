#include "edge/recorder/frame_memory.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/recorder/recorder_files.h"

namespace ols::recorder {
namespace {

TEST(FrameMemory, ForgetsWhatIsOlderThanItsSpan) {
  FrameMemory memory(2.0, 1e9);
  for (std::uint64_t i = 0; i <= 100; ++i) memory.add(noisy_frame(i, 0.1 * static_cast<double>(i)));
  EXPECT_NEAR(memory.frames().front().mid_exposure_s, 8.0, 0.051);
  EXPECT_EQ(memory.frames().back().number, 100U);
}

TEST(FrameMemory, KeepsWithinItsBytes) {
  FrameMemory memory(1e6, 10.5 * 64 * 64);
  for (std::uint64_t i = 0; i < 100; ++i) memory.add(noisy_frame(i, static_cast<double>(i)));
  EXPECT_EQ(memory.frames().size(), 10U);
  EXPECT_EQ(memory.bytes(), 10U * 64 * 64);
}

TEST(FrameMemory, AFrameGreaterThanAllIsNotKept) {
  FrameMemory memory(1e6, 100.0);
  memory.add(noisy_frame(0, 0.0));
  EXPECT_EQ(memory.bytes(), 0U);
}

TEST(FrameMemory, SharesThePixels) {
  FrameMemory memory(10.0, 1e9);
  const RecordedFrame frame = noisy_frame(0, 0.0);
  memory.add(frame);
  EXPECT_EQ(memory.frames().front().picture.data, frame.picture.data);
}

TEST(FrameMemory, HandsOutATimeWithBothEnds) {
  FrameMemory memory(100.0, 1e9);
  for (std::uint64_t i = 0; i < 10; ++i) memory.add(noisy_frame(i, static_cast<double>(i)));
  const auto found = memory.between(3.0, 5.0);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found.front().number, 3U);
  EXPECT_EQ(found.back().number, 5U);
}

}  // namespace
}  // namespace ols::recorder
