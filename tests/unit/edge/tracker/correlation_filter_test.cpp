#include "edge/tracker/correlation_filter.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::frame_at;
using testing::SyntheticScene;

WindowView view_of(const TrackerInput& frame, const cv::Rect2d& box) {
  return view_window(frame, window_around(centre_of(box), size_of(box)));
}

TEST(CorrelationFilter, PeaksWhereTheTargetHasMoved) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  const cv::Rect2d box = SyntheticScene::box_around({300.0, 220.0});
  CorrelationFilter filter(
      view_of(frame_at(0, scene.picture({400, 300}, cv::Point2d(300.0, 220.0))), box),
      size_of(box));
  const TrackerInput moved = frame_at(1, scene.picture({400, 300}, cv::Point2d(311.0, 214.0)));
  const Response response = filter.respond(view_of(moved, box));
  const Response::Peak peak = response.peak();
  EXPECT_NEAR(peak.pixel.x(), 311.0, 1.5);
  EXPECT_NEAR(peak.pixel.y(), 214.0, 1.5);
  EXPECT_GT(response.at(peak.pixel), 0.8 * peak.value);
  EXPECT_LT(response.at({300.0, 220.0}), 0.3 * peak.value);
  EXPECT_EQ(response.at({100.0, 100.0}), 0.0);  // outside the window
}

TEST(CorrelationFilter, LearnsAnotherAppearance) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  const cv::Rect2d box = SyntheticScene::box_around({300.0, 220.0});
  const TrackerInput first = frame_at(0, scene.picture({400, 300}, cv::Point2d(300.0, 220.0)));
  CorrelationFilter filter(view_of(first, box), size_of(box));
  TrackerInput inverted = first;
  inverted.gray = 255 - first.gray;
  const auto response = [&] { return filter.respond(view_of(inverted, box)).at(centre_of(box)); };
  const double before = response();
  for (int k = 0; k < 5; ++k) filter.learn(view_of(inverted, box), 1.0);
  EXPECT_GT(response(), 1.2 * before);
}

TEST(CorrelationFilter, LearnsLessOfAnImageOfLessWeight) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  const cv::Rect2d box = SyntheticScene::box_around({300.0, 220.0});
  const TrackerInput first = frame_at(0, scene.picture({400, 300}, cv::Point2d(300.0, 220.0)));
  TrackerInput inverted = first;
  inverted.gray = 255 - first.gray;
  const auto learnt = [&](double share) {
    CorrelationFilter filter(view_of(first, box), size_of(box));
    filter.learn(view_of(inverted, box), share);
    return filter.respond(view_of(inverted, box)).at(centre_of(box));
  };
  EXPECT_GT(learnt(1.0), 1.02 * learnt(0.1));
}

}  // namespace
}  // namespace ols::tracker
