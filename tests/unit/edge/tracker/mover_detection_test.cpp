#include "edge/tracker/mover_detection.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols {
namespace {

using testing::Backdrop;
using testing::distance;
using testing::shift_homography;
using testing::SyntheticScene;

const cv::Rect2d kEverywhere(0.0, 0.0, 640.0, 480.0);

MoverSearch everywhere() {
  MoverSearch search;
  search.area = kEverywhere;
  return search;
}

// The camera has moved by (20, 6), which the homography says, and the target besides.
TEST(MoverDetection, FindsWhatMovesAgainstTheScene) {
  for (const int width : {640, 320}) {
    SyntheticScene scene(Backdrop::kTextured, 1);
    const cv::Mat earlier = scene.picture({400, 300}, cv::Point2d(300.0, 220.0));
    const cv::Point2d now_at(340.0, 260.0);
    const cv::Mat now = scene.picture({420, 306}, now_at);
    const auto movers = detect_movers(earlier, shift_homography(-20.0, -6.0),
                                      reduce_frame(now, width), everywhere());
    ASSERT_FALSE(movers.empty()) << width;
    bool found = false;
    for (const MoverCandidate& mover : movers) {
      EXPECT_TRUE(mover.covariance_px2.allFinite());
      EXPECT_GT(mover.covariance_px2.determinant(), 0.0);
      found = found || distance(mover.pixel, now_at) < 6.0;
    }
    EXPECT_TRUE(found) << width;
  }
}

TEST(MoverDetection, FindsNothingInASceneAtRest) {
  for (const Backdrop backdrop : {Backdrop::kTextured, Backdrop::kSky}) {
    SyntheticScene scene(backdrop, 2);
    const cv::Mat earlier = scene.picture({400, 300}, cv::Point2d(300.0, 220.0));
    const cv::Mat now = scene.picture({400, 300}, cv::Point2d(300.0, 220.0));
    EXPECT_TRUE(
        detect_movers(earlier, Eigen::Matrix3d::Identity(), reduce_frame(now, 640), everywhere())
            .empty());
  }
}

// Half pixels at both edges, of a picture whose sides are odd.
TEST(MoverDetection, LooksUpToTheEdge) {
  for (const int width : {127, 64}) {
    const cv::Mat earlier(127, 127, CV_8U, cv::Scalar(90));
    cv::Mat now = earlier.clone();
    now(cv::Rect(118, 118, 9, 9)) = 230;
    MoverSearch search;
    search.area = {1.5, 1.5, 125.5, 125.5};
    const auto movers =
        detect_movers(earlier, Eigen::Matrix3d::Identity(), reduce_frame(now, width), search);
    ASSERT_EQ(movers.size(), 1U) << width;
    EXPECT_LT(distance(movers.front().pixel, {122.0, 122.0}), 2.0) << width;
  }
}

TEST(MoverDetection, GivesNoneForWhatItCannotUse) {
  SyntheticScene scene(Backdrop::kSky, 3);
  const cv::Mat earlier = scene.picture({400, 300}, cv::Point2d(300.0, 220.0));
  const ReducedFrame now = reduce_frame(scene.picture({400, 300}, cv::Point2d(340.0, 220.0)), 640);
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  EXPECT_FALSE(detect_movers(earlier, same, now, everywhere()).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(detect_movers({}, same, now, everywhere()).empty());
  EXPECT_TRUE(detect_movers(earlier, same, {}, everywhere()).empty());
  EXPECT_TRUE(detect_movers(earlier, Eigen::Matrix3d::Zero(), now, everywhere()).empty());
  EXPECT_TRUE(detect_movers(earlier, Eigen::Matrix3d::Constant(nan), now, everywhere()).empty());
  MoverSearch outside;
  outside.area = {900.0, 900.0, 50.0, 50.0};
  EXPECT_TRUE(detect_movers(earlier, same, now, outside).empty());
}

}  // namespace
}  // namespace ols
