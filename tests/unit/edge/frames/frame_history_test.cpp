#include "edge/frames/frame_history.h"

#include <gtest/gtest.h>

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

TEST(FrameHistory, GivesEvenlyWhatCameSince) {
  FrameHistory history(10.0);
  for (int i = 0; i < 100; ++i) history.add(frame_at(10.0 + 0.03 * i));
  EXPECT_EQ(history.since(12.5).size(), 16U) << "all of half a second";
  const auto all = history.since(9.0);
  ASSERT_LE(all.size(), FrameHistory::kMostSince);
  ASSERT_GE(all.size(), FrameHistory::kMostSince / 2);
  EXPECT_EQ(all.back(), history.find({})) << "the newest among them";
  const double apart_s = all[1]->mid_exposure_s - all[0]->mid_exposure_s;
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_NEAR(all[i]->mid_exposure_s - all[i - 1]->mid_exposure_s, apart_s, 1e-9);
  }
  EXPECT_TRUE(history.since(13.0).empty());
}

}  // namespace
}  // namespace ols::station
