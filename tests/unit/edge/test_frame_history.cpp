#include <gtest/gtest.h>

#include "edge/frame_history.h"

namespace ols::station {
namespace {

camera::Frame frame_at(double time_s) {
  camera::Frame frame;
  frame.mid_exposure_s = time_s;
  return frame;
}

TEST(FrameHistory, KeepsItsSpanAndRefusesFramesThatGoBack) {
  FrameHistory history(1.0);
  EXPECT_EQ(history.find({}), nullptr);
  for (const double time_s : {10.0, 10.5, 11.0, 11.25}) EXPECT_TRUE(history.add(frame_at(time_s)));
  EXPECT_FALSE(history.add(frame_at(11.25)));
  EXPECT_FALSE(history.add(frame_at(11.0)));
  ASSERT_EQ(history.frames().size(), 3U);
  EXPECT_EQ(history.frames().front().mid_exposure_s, 10.5);
  EXPECT_EQ(history.find({})->mid_exposure_s, 11.25);
}

TEST(FrameHistory, FindsOnlyTheFrameThatIsMeant) {
  FrameHistory history(1.0);
  for (const double time_s : {10.0, 10.1, 10.2}) history.add(frame_at(time_s));
  EXPECT_EQ(history.find(10.115)->mid_exposure_s, 10.1);
  EXPECT_EQ(history.find(10.15), nullptr) << "between two frames";
  EXPECT_EQ(history.find(9.5), nullptr);
}

}  // namespace
}  // namespace ols::station
