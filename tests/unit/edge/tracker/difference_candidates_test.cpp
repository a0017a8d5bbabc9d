#include "edge/tracker/difference_candidates.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::shift_homography;
using testing::SyntheticScene;

TEST(DifferenceCandidates, AreWhereSomethingMoved) {
  SyntheticScene scene(Backdrop::kSky, 5);
  const auto before = reduce_frame(scene.picture({400, 300}, cv::Point2d(100, 100)), 320);
  const auto after = reduce_frame(scene.picture({400, 300}, cv::Point2d(500, 200)), 320);
  EXPECT_EQ(after.reduction, 2.0);
  const cv::Rect2d all(0.0, 0.0, 640.0, 480.0);
  const auto found = difference_candidates(before, after, std::nullopt, all, {24.0, 18.0}, 4);
  ASSERT_GE(found.size(), 2U);
  for (const Eigen::Vector2d& truth : {Eigen::Vector2d(100, 100), Eigen::Vector2d(500, 200)}) {
    EXPECT_LT(std::min((found[0] - truth).norm(), (found[1] - truth).norm()), 8.0);
  }
  EXPECT_TRUE(difference_candidates(after, after, std::nullopt, all, {24.0, 18.0}, 4).empty());
  const cv::Rect2d left(0.0, 0.0, 300.0, 480.0);
  const auto there = difference_candidates(before, after, std::nullopt, left, {24.0, 18.0}, 4);
  ASSERT_FALSE(there.empty());
  EXPECT_LT((there[0] - Eigen::Vector2d(100, 100)).norm(), 8.0);
  const cv::Rect2d right(400.0, 150.0, 200.0, 100.0);
  const auto other = difference_candidates(before, after, std::nullopt, right, {24.0, 18.0}, 4);
  ASSERT_FALSE(other.empty());
  EXPECT_LT((other[0] - Eigen::Vector2d(500, 200)).norm(), 8.0);
}

TEST(DifferenceCandidates, AreThereForATargetOfHalfThePicture) {
  const auto picture_with = [](const cv::Rect& target) {
    cv::Mat picture(480, 640, CV_8U, cv::Scalar(150));
    picture(target) = 60;
    return reduce_frame(picture, 640);
  };
  const auto before = picture_with({20, 30, 201, 121});
  const auto after = picture_with({320, 230, 201, 121});
  const cv::Rect2d all(0.0, 0.0, 640.0, 480.0);
  const auto found = difference_candidates(before, after, std::nullopt, all, {201.0, 121.0}, 2);
  ASSERT_EQ(found.size(), 2U);
  for (const Eigen::Vector2d& truth : {Eigen::Vector2d(120, 90), Eigen::Vector2d(420, 290)}) {
    EXPECT_LT(std::min((found[0] - truth).norm(), (found[1] - truth).norm()), 30.0);
  }
}

// A camera that turns changes the picture everywhere, and all of it is accounted for.
TEST(DifferenceCandidates, AreOnlyTheTargetOnceTheCameraIsAccountedFor) {
  SyntheticScene scene(Backdrop::kTextured, 5);
  const auto before = reduce_frame(scene.picture({400, 300}, cv::Point2d(100, 100)), 320);
  const auto after = reduce_frame(scene.picture({440, 312}, cv::Point2d(500, 200)), 320);
  const cv::Rect2d all(0.0, 0.0, 640.0, 480.0);
  const auto found =
      difference_candidates(before, after, shift_homography(-40.0, -12.0), all, {24.0, 18.0}, 2);
  ASSERT_EQ(found.size(), 2U);
  for (const Eigen::Vector2d& truth : {Eigen::Vector2d(60, 88), Eigen::Vector2d(500, 200)}) {
    EXPECT_LT(std::min((found[0] - truth).norm(), (found[1] - truth).norm()), 8.0);
  }
}

}  // namespace
}  // namespace ols::tracker
