#include "edge/tracker/designation.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

MotionModel moving_by(double x, double y, double interval_s) {
  MotionModel motion{TrackerConfig{}};
  motion.begin_frame({testing::shift_homography(x, y), interval_s}, {0.0, 0.0});
  return motion;
}

// A bird of ten pixels in the corner of a box of forty, seen later at twice its size.
TEST(Designation, KeepsItsPlaceAndSizeAboutWhatIsFollowed) {
  const Designation designation({100.0, 100.0, 40.0, 40.0}, {105.0, 110.0, 10.0, 10.0});
  const Particle followed{{50.0, 60.0}, {0.0, 0.0}, {20.0, 20.0}};
  EXPECT_EQ(designation.point(followed), Eigen::Vector2d(70.0, 70.0));
  EXPECT_EQ(designation.box(followed), cv::Rect2d(30.5, 30.5, 80.0, 80.0));
}

TEST(Designation, FindsLateWhatComesToStandOutInTheBoxOfNow) {
  const cv::Rect2d box(100.0, 100.0, 40.0, 40.0);
  Designation designation(box, box);
  cv::Mat gray(480, 640, CV_8U, cv::Scalar(150));
  EXPECT_FALSE(designation.find_late(gray, moving_by(60.0, 0.0, 0.1)));
  cv::rectangle(gray, cv::Rect(178, 117, 10, 8), cv::Scalar(40), cv::FILLED);
  const auto core = designation.find_late(gray, moving_by(0.0, 0.0, 0.1));
  ASSERT_TRUE(core);
  EXPECT_LT((centre_of(*core) - Eigen::Vector2d(182.5, 120.5)).norm(), 2.0);
  EXPECT_LT(core->width, 25.0);
  const Particle followed{centre_of(*core), {0.0, 0.0}, size_of(*core)};
  EXPECT_EQ(designation.point(followed), followed.pixel);
  EXPECT_NEAR(designation.box(followed).width, 40.0, 1e-9);
}

TEST(Designation, IsGivenUpAfterTwoSeconds) {
  const cv::Rect2d box(100.0, 100.0, 40.0, 40.0);
  cv::Mat gray(480, 640, CV_8U, cv::Scalar(150));
  cv::rectangle(gray, cv::Rect(118, 117, 10, 8), cv::Scalar(40), cv::FILLED);
  for (const double waited_s : {0.9, 1.1}) {
    Designation designation(box, box);
    const cv::Mat blank(480, 640, CV_8U, cv::Scalar(150));
    EXPECT_FALSE(designation.find_late(blank, moving_by(0.0, 0.0, 1.0)));
    EXPECT_EQ(designation.find_late(gray, moving_by(0.0, 0.0, waited_s)).has_value(),
              waited_s < 1.0);
  }
}

}  // namespace
}  // namespace ols::tracker
