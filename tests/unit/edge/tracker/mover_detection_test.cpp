#include "edge/tracker/mover_detection.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
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

// Two that touch nowhere: each has the pixels that differ from before, and no others.
TEST(MoverDetection, BoundsEachMover) {
  const cv::Mat before(240, 320, CV_8UC1, cv::Scalar(100));
  cv::Mat now = before.clone();
  const cv::Rect first(40, 60, 7, 5), second(200, 150, 4, 9);
  now(first).setTo(160);
  now(second).setTo(150);
  MoverSearch search;
  search.area = {0.0, 0.0, 320.0, 240.0};
  const auto movers =
      detect_movers(before, Eigen::Matrix3d::Identity(), reduce_frame(now, 320), search);
  ASSERT_EQ(movers.size(), 2U);
  EXPECT_EQ(movers[0].box, cv::Rect2d(first)) << "the stronger one";
  EXPECT_EQ(movers[1].box, cv::Rect2d(second));
}

// A bright spot of this many pixels on a noisy sky, moved since: the mean normalised error squared
// an axis of the candidate nearest to it, and how often there is one.
struct Consistency {
  double nees = 0.0;
  double sd_px = 0.0;  // told, mean
  int found = 0;
};

Consistency consistency_of(double size_px, double moved_px) {
  Consistency made;
  cv::RNG noise(11);
  const auto picture = [&](const Eigen::Vector2d& at) {
    cv::Mat image(240, 320, CV_32F);
    noise.fill(image, cv::RNG::NORMAL, 100.0, 2.0);
    const double sd = size_px / 4.0;
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const double off = (Eigen::Vector2d(x, y) - at).squaredNorm();
        image.at<float>(y, x) += static_cast<float>(60.0 * std::exp(-0.5 * off / (sd * sd)));
      }
    }
    image.convertTo(image, CV_8U);
    return image;
  };
  constexpr int kPairs = 40;
  for (int i = 0; i < kPairs; ++i) {
    const Eigen::Vector2d before(150.0 + 0.13 * i, 120.0 - 0.29 * i);
    const double angle = 0.7 * i;
    const Eigen::Vector2d now =
        before + moved_px * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const auto movers = detect_movers(picture(before), Eigen::Matrix3d::Identity(),
                                      reduce_frame(picture(now), 320), everywhere());
    if (movers.empty()) continue;
    const auto nearest =
        std::min_element(movers.begin(), movers.end(), [&](const auto& a, const auto& b) {
          return (a.pixel - now).squaredNorm() < (b.pixel - now).squaredNorm();
        });
    const Eigen::Vector2d error = nearest->pixel - now;
    made.nees += 0.5 * error.dot(nearest->covariance_px2.inverse() * error);
    made.sd_px += std::sqrt(0.5 * nearest->covariance_px2.trace());
    ++made.found;
  }
  made.nees /= std::max(1, made.found);
  made.sd_px /= std::max(1, made.found);
  return made;
}

// Before it has left its own place, half of what differs is where it was.
TEST(MoverDetection, TheCovarianceHoldsWhereAMoverStandsInItsOwnShadow) {
  for (const double size_px : {4.0, 8.0, 16.0}) {
    for (const double moved_px : {4.0, 8.0, 16.0, 40.0}) {
      const Consistency seen = consistency_of(size_px, moved_px);
      EXPECT_GT(seen.found, 35) << size_px << " px moved by " << moved_px;
      EXPECT_LT(seen.nees, 1.0) << size_px << " px moved by " << moved_px;
      EXPECT_LT(seen.sd_px, 0.75 * size_px) << size_px << " px moved by " << moved_px;
    }
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
}  // namespace ols::tracker
