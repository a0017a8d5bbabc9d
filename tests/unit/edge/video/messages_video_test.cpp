#include "edge/video/messages_video.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "ols_msg/video_frame_t.hpp"
#include "ols_msg/video_request_t.hpp"
#include "ols_msg/video_stream_request_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::video {
namespace {

ols_msg::video_request_t request_message() {
  auto message = made<ols_msg::video_request_t>();
  message.max_width_px = 640;
  message.quality = 90;
  return message;
}

std::optional<VideoRequest> decoded(const ols_msg::video_request_t& message) {
  return decode_request(encoded(message));
}

ols_msg::video_frame_t answer(const VideoFrame& frame, const VideoRequest& request) {
  H264Encoder stream;
  const auto bytes = encode_frame(frame, 7, {"alfa", 42}, request, stream);
  ols_msg::video_frame_t message;
  EXPECT_EQ(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  return message;
}

// Darker on the left, brighter on the right.
VideoFrame a_frame() {
  VideoFrame frame;
  frame.utime_us = 1000;
  frame.gray = cv::Mat(100, 200, CV_8U);
  for (int x = 0; x < 200; ++x) frame.gray.col(x).setTo(x);
  return frame;
}

TEST(VideoRequestMessage, OneThatFitsTheLimitsIsTaken) {
  ols_msg::video_request_t message = request_message();
  message.after_utime = 5;
  message.region_px[2] = 10.0;
  const auto request = decoded(message);
  ASSERT_TRUE(request);
  EXPECT_EQ(request->after_utime_us, 5);
  EXPECT_EQ(request->max_width_px, 640);
  EXPECT_EQ(request->quality, 90);
  EXPECT_EQ(request->region.width, 10.0);
}

TEST(VideoRequestMessage, OneForAStream) {
  auto message = made<ols_msg::video_stream_request_t>();
  message.max_width_px = 640;
  message.quality = 60;
  message.key_frame = 1;
  const auto decoded_one = [&message] { return decode_request(encoded(message)); };
  ASSERT_TRUE(decoded_one());
  EXPECT_EQ(decoded_one()->codec, VideoCodec::kH264);
  EXPECT_TRUE(decoded_one()->key_frame);
  EXPECT_LE(message.getEncodedSize(), static_cast<int>(kLargestRequest_bytes));
  message.quality = 101;
  EXPECT_FALSE(decoded_one());
}

TEST(VideoRequestMessage, ItFitsTheLargestRequest) {
  EXPECT_LE(request_message().getEncodedSize(), static_cast<int>(kLargestRequest_bytes));
}

TEST(VideoRequestMessage, NonsenseIsRefused) {
  for (const auto& spoil : std::vector<void (*)(ols_msg::video_request_t&)>{
           [](auto& m) { m.schema_version = 99; }, [](auto& m) { m.max_width_px = 0; },
           [](auto& m) { m.max_width_px = 1 << 30; }, [](auto& m) { m.quality = 0; },
           [](auto& m) { m.quality = 101; }, [](auto& m) { m.region_px[0] = 1e9; },
           [](auto& m) { m.region_px[3] = std::numeric_limits<double>::quiet_NaN(); }}) {
    ols_msg::video_request_t message = request_message();
    spoil(message);
    EXPECT_FALSE(decoded(message));
  }
  EXPECT_FALSE(decode_request({}));
}

TEST(VideoFrameMessage, TheWholeFrameScaledDown) {
  const auto message = answer(a_frame(), {.max_width_px = 50, .quality = 95});
  EXPECT_EQ(message.station, "alfa");
  EXPECT_EQ(message.boot_id, 42);
  EXPECT_EQ(message.sequence, 7);
  EXPECT_EQ(message.full_width_px, 200);
  EXPECT_EQ(message.full_height_px, 100);
  EXPECT_DOUBLE_EQ(message.scale, 0.25);
  const cv::Mat picture = cv::imdecode(message.jpeg, cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(picture.size(), cv::Size(50, 25));
  EXPECT_NEAR(picture.at<std::uint8_t>(12, 40), 161.5, 3.0);
}

TEST(VideoFrameMessage, ARegionInFullResolution) {
  const auto message =
      answer(a_frame(), {.max_width_px = 640, .quality = 95, .region = {100, 20, 32, 16}});
  EXPECT_DOUBLE_EQ(message.scale, 1.0);
  EXPECT_EQ(message.region_px[0], 100.0);
  EXPECT_EQ(message.region_px[3], 16.0);
  const cv::Mat picture = cv::imdecode(message.jpeg, cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(picture.size(), cv::Size(32, 16));
  EXPECT_NEAR(picture.at<std::uint8_t>(8, 0), 100, 3.0);
}

TEST(VideoFrameMessage, AnAccessUnitOfAStreamHasEvenSides) {
  const VideoRequest request{.max_width_px = 51, .quality = 50, .codec = VideoCodec::kH264};
  const auto message = answer(a_frame(), request);
  EXPECT_DOUBLE_EQ(message.scale, 0.25);
  ASSERT_GT(message.jpeg.size(), 5U);
  EXPECT_EQ(std::vector<std::uint8_t>(message.jpeg.begin(), message.jpeg.begin() + 5),
            (std::vector<std::uint8_t>{0, 0, 0, 1, 0x67}));
}

TEST(VideoFrameMessage, WhatIsNotKnownIsNotANumber) {
  const auto message = answer(a_frame(), {.max_width_px = 50, .quality = 50});
  EXPECT_FALSE(message.has_box);
  EXPECT_TRUE(std::isnan(message.belief));
  EXPECT_TRUE(std::isnan(message.camera_ecef_m[0]));
  EXPECT_TRUE(std::isnan(message.camera_from_ecef[8]));
  EXPECT_TRUE(std::isnan(message.camera_matrix_px[0]));
}

TEST(VideoFrameMessage, BoxAndCamera) {
  VideoFrame frame = a_frame();
  frame.box = cv::Rect2d(1, 2, 3, 4);
  frame.belief = 0.75;
  frame.track_id = 9;
  CameraView camera;
  camera.centre_ecef = {1, 2, 3};
  camera.R_camera_ecef << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  camera.intrinsics.k1 = 0.05;
  camera.intrinsics.model = LensModel::kPolynomial;
  camera.intrinsics.k4 = 0.25;
  frame.camera = camera;
  const auto message = answer(frame, {.max_width_px = 50, .quality = 50});
  EXPECT_TRUE(message.has_box);
  EXPECT_EQ(message.box_px[3], 4.0);
  EXPECT_EQ(message.belief, 0.75);
  EXPECT_EQ(message.track_id, 9);
  EXPECT_EQ(message.camera_ecef_m[2], 3.0);
  EXPECT_EQ(message.camera_from_ecef[1], 1.0) << "by rows";
  EXPECT_EQ(message.camera_from_ecef[3], 0.0);
  EXPECT_EQ(message.camera_matrix_px[0], camera.intrinsics.fx_px);
  EXPECT_EQ(message.distortion[0], 0.05);
  EXPECT_EQ(message.lens_model, 2);
  EXPECT_EQ(message.lens_k4, 0.25);
}

}  // namespace
}  // namespace ols::video
