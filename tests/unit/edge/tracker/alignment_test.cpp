#include "edge/tracker/alignment.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

TEST(ReducedArea, IsWhatTheAreaTouchesInsideTheImage) {
  const ReducedFrame frame{cv::Mat(100, 200, CV_8U), 4.0};
  EXPECT_EQ(reduced_area(frame, {5.0, 9.0, 10.0, 3.0}), cv::Rect(1, 2, 3, 1));
  EXPECT_EQ(reduced_area(frame, {-50.0, 390.0, 1000.0, 1000.0}), cv::Rect(0, 97, 200, 3));
  EXPECT_TRUE(reduced_area(frame, {900.0, 500.0, 10.0, 10.0}).empty());
}

TEST(BroughtToPresent, LaysTheEarlierImageOntoAPartOfThePresentOne) {
  cv::Mat earlier(60, 80, CV_8U, cv::Scalar(10));
  earlier.at<std::uint8_t>(20, 30) = 200;
  const cv::Mat now(30, 40, CV_8U, cv::Scalar(99));
  const cv::Mat brought =
      brought_to_present(earlier, testing::shift_homography(5.0, 3.0), now, {15, 10});
  ASSERT_EQ(brought.size(), now.size());
  EXPECT_EQ(brought.at<std::uint8_t>(13, 20), 200);  // (30 + 5 - 15, 20 + 3 - 10)
  EXPECT_EQ(brought.at<std::uint8_t>(0, 0), 10);
}

// What the earlier image did not see is as it is now.
TEST(BroughtToPresent, LeavesWhatWasNotSeen) {
  const cv::Mat earlier(60, 80, CV_8U, cv::Scalar(10));
  const cv::Mat now(60, 80, CV_8U, cv::Scalar(99));
  const cv::Mat brought =
      brought_to_present(earlier, testing::shift_homography(40.0, 0.0), now, {0, 0});
  EXPECT_EQ(brought.at<std::uint8_t>(30, 20), 99);
  EXPECT_EQ(brought.at<std::uint8_t>(30, 60), 10);
}

}  // namespace
}  // namespace ols::tracker
