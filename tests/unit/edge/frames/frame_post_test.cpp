#include "edge/frames/frame_post.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/unit/eventually.h"

namespace ols::station {
namespace {

RequestedFrame frame_of(bool lossless) {
  RequestedFrame one;
  one.request.lossless = lossless;
  one.frame.gray = cv::Mat(60, 80, CV_8U);
  cv::randu(one.frame.gray, 0, 255);
  return one;
}

TEST(FramePost, AFrameBecomesAPictureFile) {
  FramePost post;
  const RequestedFrame sent = frame_of(true);
  ASSERT_TRUE(post.put(sent));
  std::optional<EncodedFrame> done;
  ASSERT_TRUE(eventually([&] { return (done = post.take()).has_value(); }));
  const cv::Mat read = cv::imdecode(done->file, cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(read, sent.frame.gray, cv::NORM_INF), 0.0);
  EXPECT_FALSE(post.take());
}

TEST(FramePost, AJpegIsOne) {
  FramePost post;
  ASSERT_TRUE(post.put(frame_of(false)));
  std::optional<EncodedFrame> done;
  ASSERT_TRUE(eventually([&] { return (done = post.take()).has_value(); }));
  ASSERT_GT(done->file.size(), 2U);
  EXPECT_EQ(done->file[0], 0xFF);
  EXPECT_EQ(done->file[1], 0xD8);
}

TEST(FramePost, TooManyAreRefused) {
  FramePost post;
  int taken = 0;
  for (int i = 0; i < 10; ++i) taken += post.put(frame_of(true)) ? 1 : 0;
  EXPECT_EQ(taken, 3);
}

}  // namespace
}  // namespace ols::station
