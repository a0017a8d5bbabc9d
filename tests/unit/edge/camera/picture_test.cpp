#include "edge/camera/picture.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

namespace ols::camera {
namespace {

constexpr int kWidth = 32, kHeight = 24;

RawPicture raw(const std::vector<std::uint8_t>& bytes, PixelFormat format) {
  return {.data = bytes.data(),
          .bytes = bytes.size(),
          .width_px = kWidth,
          .height_px = kHeight,
          .format = static_cast<std::uint32_t>(format)};
}

PictureFormat expected(PixelFormat format) {
  return {.width_px = kWidth, .height_px = kHeight, .format = format};
}

// The mosaic of an evenly coloured scene; `names` are the colours of its first 2 x 2 pixels.
std::vector<std::uint8_t> mosaic(const char* names, std::uint8_t r, std::uint8_t g,
                                 std::uint8_t b) {
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const char name = names[2 * (y % 2) + x % 2];
      bytes.push_back(name == 'R' ? r : name == 'G' ? g : b);
    }
  return bytes;
}

TEST(Picture, Mono8IsCopiedOnce) {
  std::vector<std::uint8_t> bytes(kWidth * kHeight);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7);
  const cv::Mat gray = to_gray(raw(bytes, PixelFormat::kMono8));
  ASSERT_EQ(gray.type(), CV_8UC1);
  ASSERT_EQ(gray.size(), cv::Size(kWidth, kHeight));
  EXPECT_NE(gray.data, bytes.data());  // the camera will write over its own
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), gray.data));
}

TEST(Picture, WhatTheCameraSentIsKeptBesideTheGray) {
  const auto bytes = mosaic("RGGB", 200, 100, 20);
  const cv::Mat bayer = raw_beside_gray(raw(bytes, PixelFormat::kBayerRG8));
  ASSERT_EQ(bayer.type(), CV_8UC1);
  EXPECT_NE(bayer.data, bytes.data());  // the camera will write over its own
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), bayer.data));
  EXPECT_TRUE(raw_beside_gray(raw(bytes, PixelFormat::kMono8)).empty()) << "the gray one is it";
  std::vector<std::uint8_t> colours(3 * kWidth * kHeight);
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = static_cast<std::uint8_t>(i * 7);
  const cv::Mat rgb = raw_beside_gray(raw(colours, PixelFormat::kRGB8));
  ASSERT_EQ(rgb.type(), CV_8UC3);
  EXPECT_TRUE(std::equal(colours.begin(), colours.end(), rgb.data));
}

TEST(Picture, EachBayerPatternGivesTheBrightnessOfItsColours) {
  const std::vector<std::tuple<PixelFormat, const char*>> patterns{
      {PixelFormat::kBayerRG8, "RGGB"},
      {PixelFormat::kBayerGR8, "GRBG"},
      {PixelFormat::kBayerGB8, "GBRG"},
      {PixelFormat::kBayerBG8, "BGGR"}};
  // Red and blue differ, so that a swapped pattern shows. ITU-R BT.601's brightness.
  const double brightness = 0.299 * 200 + 0.587 * 100 + 0.114 * 20;
  for (const auto& [format, names] : patterns) {
    const auto bytes = mosaic(names, 200, 100, 20);
    const cv::Mat gray = to_gray(raw(bytes, format));
    EXPECT_NEAR(gray.at<std::uint8_t>(kHeight / 2, kWidth / 2), brightness, 1.5) << names;
    EXPECT_NEAR(gray.at<std::uint8_t>(kHeight / 2 + 1, kWidth / 2), brightness, 1.5) << names;
  }
}

TEST(Picture, ColourGivesTheBrightnessOfItsColours) {
  for (const PixelFormat format : {PixelFormat::kRGB8, PixelFormat::kBGR8}) {
    const bool red_first = format == PixelFormat::kRGB8;
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < kWidth * kHeight; ++i)
      for (const int level : {red_first ? 200 : 20, 100, red_first ? 20 : 200})
        bytes.push_back(static_cast<std::uint8_t>(level));
    const RawPicture picture = raw(bytes, format);
    EXPECT_EQ(check(picture, expected(format)), PictureRefusal::kNone);
    const cv::Mat gray = to_gray(picture);
    ASSERT_EQ(gray.type(), CV_8UC1);
    EXPECT_NEAR(gray.at<std::uint8_t>(5, 7), 0.299 * 200 + 0.587 * 100 + 0.114 * 20, 1.0);
    RawPicture torn = picture;
    torn.bytes = kWidth * kHeight;  // enough for one channel only
    EXPECT_EQ(check(torn, expected(format)), PictureRefusal::kTooShort);
  }
}

TEST(Picture, RefusesWithAReason) {
  const std::vector<std::uint8_t> bytes(kWidth * kHeight);
  const RawPicture good = raw(bytes, PixelFormat::kMono8);
  EXPECT_EQ(check(good, expected(PixelFormat::kMono8)), PictureRefusal::kNone);
  EXPECT_EQ(check(good, expected(PixelFormat::kBayerRG8)), PictureRefusal::kWrongFormat);

  RawPicture wide = good;
  wide.width_px = kWidth + 1;
  EXPECT_EQ(check(wide, expected(PixelFormat::kMono8)), PictureRefusal::kWrongSize);
  RawPicture low = good;
  low.height_px = kHeight / 2;
  EXPECT_EQ(check(low, expected(PixelFormat::kMono8)), PictureRefusal::kWrongSize);
  RawPicture torn = good;
  torn.bytes -= 1;
  EXPECT_EQ(check(torn, expected(PixelFormat::kMono8)), PictureRefusal::kTooShort);
  RawPicture empty = good;
  empty.data = nullptr;
  EXPECT_EQ(check(empty, expected(PixelFormat::kMono8)), PictureRefusal::kTooShort);
}

TEST(Picture, NamesOfFormats) {
  EXPECT_EQ(pixel_format("Mono8"), PixelFormat::kMono8);
  EXPECT_EQ(pixel_format("BayerGB8"), PixelFormat::kBayerGB8);
  EXPECT_EQ(pixel_format("RGB8"), PixelFormat::kRGB8);
  EXPECT_FALSE(pixel_format("Mono16"));
  EXPECT_EQ(pixel_format_name(0x0108000a), "BayerGB8");
  EXPECT_EQ(pixel_format_name(0x01100007), "0x01100007");
}

}  // namespace
}  // namespace ols::camera
