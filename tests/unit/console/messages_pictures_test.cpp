#include "console/messages_pictures.h"

#include <gtest/gtest.h>

#include <limits>

#include "ols_msg/preview_t.hpp"
#include "ols_msg/video_frame_t.hpp"
#include "ols_msg/video_request_t.hpp"
#include "ols_msg/video_stream_request_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::console {
namespace {

TEST(ConsolePictures, APictureKeepsItsFramesTimeAndBox) {
  auto preview = made<ols_msg::preview_t>();
  preview.station = "alfa";
  preview.utime = 1'700'000'000'000'001;
  preview.full_width_px = 1280;
  preview.full_height_px = 960;
  preview.scale = 0.25;
  preview.has_box = 1;
  preview.box_px[0] = 10.0;
  preview.jpeg_bytes = 3;
  preview.jpeg = {1, 2, 3};
  const auto picture = picture_from(on("OLS_PREVIEW_alfa", preview));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->header.at("utime_us"), preview.utime);
  EXPECT_EQ(picture->header.at("box_px")[0], 10.0);
  EXPECT_EQ(picture->bytes.size(), 3U);
}

TEST(ConsolePictures, ARequestForVideo) {
  const auto bytes = video_request(7, 640, 60);
  ols_msg::video_request_t request;
  ASSERT_EQ(request.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  EXPECT_EQ(request.after_utime, 7);
  EXPECT_EQ(request.max_width_px, 640);
  EXPECT_EQ(request.quality, 60);
}

TEST(ConsolePictures, ARequestForAStream) {
  for (const bool key_frame : {false, true}) {
    const auto bytes = stream_request(7, 640, 60, key_frame);
    ols_msg::video_stream_request_t request;
    ASSERT_EQ(request.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
              static_cast<int>(bytes.size()));
    EXPECT_EQ(request.after_utime, 7);
    EXPECT_EQ(request.quality, 60);
    EXPECT_EQ(request.key_frame != 0, key_frame);
  }
}

TEST(ConsolePictures, APictureOfTheVideoHasItsCameraUnlessThatIsUnknown) {
  auto frame = made<ols_msg::video_frame_t>();
  frame.station = "alfa";
  frame.utime = 9;
  frame.belief = 0.5;
  frame.camera_from_ecef[0] = 1.0;
  frame.jpeg = {1, 2, 3};
  frame.jpeg_bytes = 3;
  const auto picture = [&frame] { return video_picture_from(on("", frame).payload, Codec::kJpeg); };
  ASSERT_TRUE(picture());
  EXPECT_TRUE(picture()->is_video);
  EXPECT_EQ(picture()->bytes, "\1\2\3");
  EXPECT_EQ(picture()->header.at("utime_us"), 9);
  EXPECT_EQ(picture()->header.at("camera").at("from_ecef").at(0), 1.0);
  frame.camera_from_ecef[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(picture()->header.at("camera").is_null());
  frame.schema_version = 99;
  EXPECT_FALSE(picture());
  EXPECT_FALSE(video_picture_from({}, Codec::kJpeg));
}

TEST(ConsolePictures, AnAccessUnitWithTheStreamsParametersIsAKeyFrame) {
  auto frame = made<ols_msg::video_frame_t>();
  const auto is_key = [&frame](const std::vector<std::uint8_t>& unit) {
    frame.jpeg = unit;
    frame.jpeg_bytes = static_cast<std::int32_t>(unit.size());
    return video_picture_from(on("", frame).payload, Codec::kH264)->is_key;
  };
  EXPECT_TRUE(is_key({0, 0, 0, 1, 0x67, 0x4d}));
  EXPECT_TRUE(is_key({0, 0, 1, 0x27, 0x4d}));
  EXPECT_FALSE(is_key({0, 0, 0, 1, 0x61, 0x67}));
  EXPECT_FALSE(is_key({0, 0, 1}));
  EXPECT_FALSE(is_key({}));
}

}  // namespace
}  // namespace ols::console
