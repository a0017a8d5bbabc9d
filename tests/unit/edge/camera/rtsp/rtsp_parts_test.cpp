#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edge/camera/picture_change.h"
#include "edge/camera/retry_pause.h"
#include "edge/camera/rtsp/rtp_pictures.h"
#include "edge/camera/rtsp/rtsp_codec.h"
#include "edge/camera/rtsp/rtsp_config.h"
#include "tests/unit/error_text.h"

namespace ols::camera {
namespace {

using testing::HasSubstr;

std::string complaint(const std::string& text) {
  return error_text<ConfigError>([&] {
    RtspConfig config;
    ConfigFile file(text, "station.toml");
    config::read(rtsp_section(config), file.root());
  });
}

TEST(RtspConfig, NeedsAnAddressWithoutLogin) {
  RtspConfig config;
  ConfigFile file("url = 'rtsp://10.0.0.5:554/a@b'", "station.toml");
  config::read(rtsp_section(config), file.root());
  for (const auto& [text, what] :
       {std::pair{"", "url"}, std::pair{"url = \"http://10.0.0.5/\"", "rtsp://"},
        std::pair{"url = \"rtsp://\"", "rtsp://"},
        std::pair{"url = \"rtsp://admin:x@10.0.0.5/\"", "password_file"},
        std::pair{"url = \"rtsp://admin:x/y@10.0.0.5/\"", "password_file"},
        std::pair{"url = \"rtsp://h/user=admin&password=geheim&c=1\"", "{password}"},
        std::pair{"url = \"rtsp://h/c?usr=admin&Pwd=geheim\"", "{password}"},
        std::pair{"url = \"rtsp://h/c?user=admin&pass=geheim\"", "{password}"},
        std::pair{"url = \"rtsp://h/user={user}&password={password}\"", "need user"},
        std::pair{"url = \"rtsps://h/\"\ntransport = \"udp\"", "needs tcp"},
        std::pair{"url = \"rtsp://h/\"\nuser = \"admin\"", "password_file"},
        std::pair{"url = \"rtsp://h/\"\npixel_format = \"BayerRG8\"", "Mono8 or BGR8"},
        std::pair{"url = \"rtsp://h/\"\nexposure_us = 5", "exposure_us"}}) {
    EXPECT_THAT(complaint(std::string(text) + "\n"), HasSubstr(what));
  }
  EXPECT_EQ(shown_url("rtsp://10.0.0.5:554?user=a&password=b"), "rtsp://10.0.0.5:554/...");
  EXPECT_EQ(shown_url("rtsp://10.0.0.5:554/user=a_password=b?c"), "rtsp://10.0.0.5:554/...");
}

TEST(RtspConfig, APasswordThatACameraWantsInTheAddressStaysInItsFile) {
  RtspConfig config;
  ConfigFile file(
      "url = 'rtsp://h/user={user}&password={password}&c=1'\nuser = 'a b'\n"
      "password_file = '/etc/ols/camera-password'",
      "station.toml");
  config::read(rtsp_section(config), file.root());
  EXPECT_EQ(filled_url(config, "p{user}/&"), "rtsp://h/user=a%20b&password=p%7Buser%7D%2F%26&c=1");
  EXPECT_EQ(shown_url(config.url), "rtsp://h/...");
}

RtpPacket packet(std::uint16_t sequence, std::uint32_t stamp, bool last = true) {
  return {.sequence = sequence,
          .last = last,
          .stamp = stamp,
          .pts_ns = stamp,
          .arrival_s = 1.0 * sequence,
          .report_utc_ns = {}};
}

TEST(RtpPictures, CountThroughTheEndsOfBothCounters) {
  RtpPictures pictures(90000.0);
  pictures.add(packet(65534, 0xfffffff0U));
  pictures.add(packet(65535, 0xfffffff0U));
  pictures.add(packet(0, 9000 - 16));
  pictures.decoding(0xfffffff0U, true);
  pictures.decoding(9000 - 16, false);
  const auto first = pictures.take(0xfffffff0U), second = pictures.take(9000 - 16);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->arrival_s, 65534.0) << "of the first packet";
  EXPECT_EQ(second->device_ns - first->device_ns, 100'000'000);
  EXPECT_EQ(second->number, first->number + 1);
  EXPECT_FALSE(second->broken);
  EXPECT_EQ(pictures.lost_packets(), 0U);
  EXPECT_FALSE(pictures.take(4711));
}

TEST(RtpPictures, StampsThatLeapStayWithinWhatTimesCanHold) {
  RtpPictures pictures(1000.0);
  std::int64_t last_ns = 0;
  for (std::uint16_t i = 0; i < 5000; ++i) {
    RtpPacket leaps = packet(i, 0x7fffffffU * i);
    leaps.pts_ns = i;
    pictures.add(leaps);
    last_ns = pictures.take(i)->device_ns;
  }
  EXPECT_EQ(last_ns, std::int64_t{1} << 61);
}

TEST(RtpPacket, ItsHeadIsReadWhateverFollows) {
  const std::vector<std::uint8_t> bytes{0x90, 0xe0, 0x12, 0x34, 0x89, 0xab, 0xcd, 0xef, 0xff};
  const auto read = rtp_packet(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sequence, 0x1234);
  EXPECT_EQ(read->stamp, 0x89abcdefU);
  EXPECT_TRUE(read->last);
  EXPECT_FALSE(rtp_packet(std::span(bytes).first(7)));
}

TEST(RtspCodec, AFormatIsKnownAndARateIsPossible) {
  EXPECT_NE(rtsp_codec("H265"), nullptr);
  EXPECT_EQ(rtsp_codec("VP8"), nullptr);
  EXPECT_TRUE(is_rtp_clock(90'000));
  for (const int hz : {-90'000, 0, 1, 2'000'000'000}) EXPECT_FALSE(is_rtp_clock(hz)) << hz;
}

TEST(RtpPictures, ALostPacketBreaksAllPicturesUntilAWholeOne) {
  RtpPictures pictures(90000.0);
  const auto broken = [&](std::uint16_t sequence, bool whole) {
    pictures.add(packet(sequence, 100U * sequence));
    pictures.decoding(100U * sequence, whole);
    return pictures.take(100U * sequence)->broken;
  };
  EXPECT_FALSE(broken(1, true));
  EXPECT_FALSE(broken(2, false));
  EXPECT_TRUE(broken(5, false));
  EXPECT_TRUE(broken(6, false));
  EXPECT_FALSE(broken(7, true));
  EXPECT_TRUE(broken(9, true)) << "its own beginning may be lost";
  EXPECT_EQ(pictures.lost_packets(), 3U);
}

TEST(RtpPictures, ALostEndBreaksItsPicture) {
  for (const bool ended : {false, true}) {
    RtpPictures pictures(90000.0);
    pictures.add(packet(1, 100, ended));
    pictures.add(packet(3, 200));
    pictures.decoding(100, true);
    EXPECT_EQ(pictures.take(100)->broken, !ended);
  }
}

TEST(RtpPictures, APictureThatIsMissingBreaksThoseThatNeedIt) {
  RtpPictures pictures(90000.0);
  for (std::uint16_t i = 1; i <= 4; ++i) pictures.add(packet(i, 100U * i));
  pictures.decoding(100, true);
  pictures.decoding(300, false);  // too little was left of 200
  pictures.decoding(400, true);
  EXPECT_FALSE(pictures.take(100)->broken);
  EXPECT_TRUE(pictures.take(300)->broken);
  EXPECT_FALSE(pictures.take(400)->broken);
}

TEST(RtpPictures, APictureThatIsShownBeforeAnEarlierSentOneTakesNothingAway) {
  RtpPictures pictures(90000.0);
  pictures.add(packet(1, 200));  // P
  pictures.add(packet(2, 100));  // B
  for (std::uint64_t pts : {200, 100}) pictures.decoding(pts, pts == 200);
  EXPECT_TRUE(pictures.take(100));
  EXPECT_TRUE(pictures.take(200));
}

TEST(RetryPause, GrowsWhileNothingComes) {
  RetryPause pause;
  EXPECT_EQ(pause.after_stream(0.0), 0.5);
  EXPECT_EQ(pause.after_stream(0.0), 1.0);
  for (int i = 0; i < 10; ++i) pause.after_stream(2.0);
  EXPECT_EQ(pause.after_stream(0.0), RetryPause::kLongest_s);
  EXPECT_EQ(pause.after_stream(60.0), 0.5) << "it was well";
}

TEST(PictureChange, ALivePictureHasNoise) {
  PictureChange change;
  cv::Mat picture(64, 64, CV_8U, cv::Scalar(90));
  EXPECT_EQ(change.unchanged_s(picture, 10.0), 0.0);
  EXPECT_EQ(change.unchanged_s(picture, 15.0), 5.0);
  picture.at<std::uint8_t>(8, 31) ^= 1;
  EXPECT_EQ(change.unchanged_s(picture, 16.0), 0.0);
  picture.at<std::uint8_t>(8, 31) ^= 1;
  EXPECT_EQ(change.unchanged_s(picture, 18.0), 2.0) << "the first one again";
}

}  // namespace
}  // namespace ols::camera
