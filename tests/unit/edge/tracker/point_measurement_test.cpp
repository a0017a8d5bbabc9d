#include "edge/tracker/point_measurement.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::kStart;
using testing::SyntheticScene;

TEST(PointMeasurement, IsOfTheDesignatedPointWithTheSizeThatTheImageShows) {
  SyntheticScene pictures(Backdrop::kSky, 2);
  const TrackerConfig config;
  const cv::Rect2d box = SyntheticScene::box_around(kStart);
  const TargetModel target(config, pictures.picture({400, 300}, kStart), box);
  const cv::Point2d now = kStart + cv::Point2d(3.3, -2.6);
  const Scene scene = target.make_scene(pictures.picture({400, 300}, now), {}, box,
                                        ReferenceFrames(config.reference_interval_s));
  const auto placed = target.place(scene, centre_of(box), size_of(box));
  ASSERT_TRUE(placed);
  PointMeasurement measurement;
  EXPECT_FALSE(measurement.size_px());
  const Eigen::Vector2d place(0.25, -0.5);
  const MeasuredPoint middle =
      measurement.measure(target, scene, *placed, size_of(box), Eigen::Vector2d::Zero(), 0.1);
  const MeasuredPoint corner =
      measurement.measure(target, scene, *placed, size_of(box), place, 0.1);
  EXPECT_LT((middle.pixel - Eigen::Vector2d(now.x, now.y)).norm(), 0.2);
  EXPECT_LT((corner.pixel - middle.pixel - place.cwiseProduct(size_of(box))).norm(), 0.5);
  EXPECT_GT(corner.covariance_px2.trace(), middle.covariance_px2.trace())
      << "the size is uncertain";
  ASSERT_TRUE(measurement.size_px());
  EXPECT_LT((*measurement.size_px() - size_of(box)).norm(), 1.0);
  measurement.miss();
  EXPECT_FALSE(measurement.size_px());
}

}  // namespace
}  // namespace ols::tracker
