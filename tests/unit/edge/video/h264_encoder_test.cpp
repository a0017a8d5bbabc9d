// Decoded by openh264's decoder here, by ffmpeg in tests/e2e/test_video.py, and by a browser in
// tests/e2e/test_console_thin_link.py.
#include "edge/video/h264_encoder.h"

#include <gtest/gtest.h>
#include <wels/codec_api.h>

#include <cmath>

namespace ols::video {
namespace {

using Unit = std::vector<std::uint8_t>;

class Decoder {
 public:
  Decoder() {
    EXPECT_EQ(WelsCreateDecoder(&decoder_), 0);
    SDecodingParam parameters{};
    parameters.sVideoProperty.eVideoBsType = VIDEO_BITSTREAM_AVC;
    parameters.eEcActiveIdc = ERROR_CON_DISABLE;
    int silent = WELS_LOG_QUIET;
    decoder_->SetOption(DECODER_OPTION_TRACE_LEVEL, &silent);
    EXPECT_EQ(decoder_->Initialize(&parameters), 0);
  }
  ~Decoder() {
    decoder_->Uninitialize();
    WelsDestroyDecoder(decoder_);
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  // The picture of this unit; empty: it cannot be decoded, or only with a later one.
  cv::Mat decode(const Unit& unit) {
    unsigned char* planes[3] = {};
    SBufferInfo info{};
    const auto state =
        decoder_->DecodeFrameNoDelay(unit.data(), static_cast<int>(unit.size()), planes, &info);
    if (state != dsErrorFree || info.iBufferStatus != 1) return {};
    const SSysMEMBuffer& of = info.UsrData.sSystemBuffer;
    return cv::Mat(of.iHeight, of.iWidth, CV_8U, planes[0], static_cast<std::size_t>(of.iStride[0]))
        .clone();
  }

 private:
  ISVCDecoder* decoder_ = nullptr;
};

// A slope from black to white, with a small bright thing at x.
cv::Mat scene(int x) {
  cv::Mat gray(96, 256, CV_8U);
  for (int column = 0; column < gray.cols; ++column) gray.col(column).setTo(column);
  gray(cv::Rect(x, 40, 3, 3)).setTo(255);
  return gray;
}

double root_mean_square(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L2) / std::sqrt(static_cast<double>(a.total()));
}

TEST(H264Encoder, EachUnitIsDecodedToItsOwnPictureAtOnce) {
  H264Encoder encoder;
  Decoder decoder;
  for (int i = 0; i < 10; ++i) {
    const cv::Mat gray = scene(10 + 4 * i);
    const cv::Mat seen = decoder.decode(encoder.encode(gray, 80, false, 1000 * i));
    ASSERT_EQ(seen.size(), gray.size()) << i;
    EXPECT_LT(root_mean_square(seen, gray), 3.0) << i;
    EXPECT_GT(seen.at<std::uint8_t>(41, 11 + 4 * i), 180) << "the small thing, picture " << i;
  }
}

TEST(H264Encoder, WhatStandsStillCostsLittle) {
  H264Encoder encoder;
  const std::size_t first = encoder.encode(scene(10), 65, false, 0).size();
  EXPECT_LT(encoder.encode(scene(10), 65, false, 1000).size(), first / 4);
}

TEST(H264Encoder, AtAKeyFrameADecoderCanBegin) {
  H264Encoder encoder;
  static_cast<void>(encoder.encode(scene(10), 80, false, 0));
  const Unit follows = encoder.encode(scene(14), 80, false, 1000);
  const Unit key = encoder.encode(scene(18), 80, true, 2000);
  EXPECT_TRUE(Decoder().decode(follows).empty());
  EXPECT_EQ(Decoder().decode(key).size(), scene(18).size());
}

TEST(H264Encoder, AnotherSizeOrQualityBeginsAgain) {
  H264Encoder encoder;
  static_cast<void>(encoder.encode(scene(10), 80, false, 0));
  EXPECT_FALSE(Decoder().decode(encoder.encode(scene(10), 60, false, 1000)).empty());
  const cv::Mat part = scene(10)(cv::Rect(0, 0, 64, 48));
  EXPECT_EQ(Decoder().decode(encoder.encode(part, 60, false, 2000)).size(), part.size());
}

TEST(H264Encoder, ABetterQualityIsTruerAndLarger) {
  cv::Mat noisy(96, 256, CV_8U);
  cv::RNG random(7);
  random.fill(noisy, cv::RNG::NORMAL, 100, 12);
  double last_error = 1e9;
  std::size_t last_size = 0;
  for (const int quality : {1, 40, 65, 100}) {
    const Unit unit = H264Encoder().encode(noisy, quality, false, 0);
    const double error = root_mean_square(Decoder().decode(unit), noisy);
    EXPECT_LT(error, last_error);
    EXPECT_GT(unit.size(), last_size);
    last_error = error;
    last_size = unit.size();
  }
}

TEST(H264Encoder, WhatItCannotCodeIsSaid) {
  EXPECT_TRUE(H264Encoder().encode(cv::Mat(8, 8, CV_8U, cv::Scalar(0)), 60, false, 0).empty());
}

}  // namespace
}  // namespace ols::video
