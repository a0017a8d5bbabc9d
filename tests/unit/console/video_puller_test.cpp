// Against the station's own video server.
#include "console/video_puller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <iterator>

#include "edge/video/video_server.h"
#include "tests/unit/eventually.h"

namespace ols::console {
namespace {

video::VideoFrame frame_at(std::int64_t utime_us) {
  video::VideoFrame frame;
  frame.utime_us = utime_us;
  frame.gray = cv::Mat(48, 64, CV_8U, cv::Scalar(100));
  return frame;
}

unsigned short free_port(const std::string& ip) {
  boost::asio::io_context io;
  boost::asio::ip::tcp::acceptor probe(io, {boost::asio::ip::make_address(ip), 0});
  return probe.local_endpoint().port();
}

// A station on a loopback address of its own, at a port that was free a moment ago.
struct Station {
  explicit Station(const std::string& id, const std::string& ip)
      : Station(id, ip, std::to_string(free_port(ip))) {}
  Station(const std::string& id, const std::string& ip, const std::string& port)
      : address(ip + ":" + port), server({address, {"127.0.0.0/8"}}, {id, 1}) {
    EXPECT_TRUE(eventually([this] { return server.report().state == device::DeviceState::kOk; }));
  }
  std::string address;
  video::VideoServer server;
};

// The instant of the newest picture of a station; 0: none.
std::int64_t newest(VideoPuller& puller, const std::string& station) {
  std::int64_t utime_us = 0;
  for (const Picture& picture : puller.take()) {
    if (picture.station == station) utime_us = picture.header.at("utime_us");
  }
  return utime_us;
}

TEST(VideoPuller, TheNewestPictureOfEachStationThatIsWatched) {
  Station alfa("alfa", "127.0.0.91"), bravo("bravo", "127.0.0.92");
  alfa.server.offer(frame_at(1));
  bravo.server.offer(frame_at(2));
  VideoPuller puller({"127.0.0.0/8"}, {});
  puller.watch({{{"alfa"}, alfa.address}});
  EXPECT_TRUE(eventually([&] { return newest(puller, "alfa") == 1; }));
  EXPECT_FALSE(bravo.server.has_viewers());
  alfa.server.offer(frame_at(3));
  EXPECT_TRUE(eventually([&] { return newest(puller, "alfa") == 3; }));
  puller.watch({{{"bravo"}, bravo.address}});
  EXPECT_TRUE(eventually([&] { return newest(puller, "bravo") == 2; }));
  EXPECT_TRUE(eventually([&] { return !alfa.server.has_viewers(); }));
}

TEST(VideoPuller, OfAStreamEachUnitFromAKeyFrameOn) {
  Station alfa("alfa", "127.0.0.91");
  VideoPuller puller({"127.0.0.0/8"}, {});
  puller.watch({{{"alfa", Codec::kH264}, alfa.address}});
  std::vector<Picture> units;
  for (std::int64_t i = 1; i <= 3; ++i) {
    alfa.server.offer(frame_at(i));
    ASSERT_TRUE(eventually([&] {
      std::ranges::move(puller.take(), std::back_inserter(units));
      return units.size() == static_cast<std::size_t>(i);
    }));
  }
  EXPECT_TRUE(units[0].is_key);
  EXPECT_FALSE(units[1].is_key);
  EXPECT_FALSE(units[2].is_key);
  EXPECT_EQ(units[2].codec, Codec::kH264);
  EXPECT_EQ(units[2].header.at("utime_us"), 3);
}

TEST(VideoPuller, AStationThatComesBackIsPulledAgain) {
  VideoPuller puller({"127.0.0.0/8"}, {});
  const std::string port = std::to_string(free_port("127.0.0.91"));
  auto alfa = std::make_unique<Station>("alfa", "127.0.0.91", port);
  const std::string address = alfa->address;
  alfa->server.offer(frame_at(9));
  puller.watch({{{"alfa"}, address}});
  EXPECT_TRUE(eventually([&] { return newest(puller, "alfa") == 9; }));
  alfa.reset();
  alfa = std::make_unique<Station>("alfa", "127.0.0.91", port);
  alfa->server.offer(frame_at(5));  // by another clock
  EXPECT_TRUE(eventually([&] { return newest(puller, "alfa") == 5; }));
}

TEST(VideoPuller, AddressesThatAreForgedAreNotAsked) {
  Station alfa("alfa", "127.0.0.91"), bravo("bravo", "127.0.0.92");
  alfa.server.offer(frame_at(1));
  bravo.server.offer(frame_at(1));
  VideoPuller puller({"127.0.0.92/32"}, {});
  puller.watch({{{"alfa"}, alfa.address}, {{"bravo"}, bravo.address}, {{"charlie"}, "nonsense"}});
  EXPECT_TRUE(eventually([&] { return newest(puller, "bravo") == 1; }));
  EXPECT_FALSE(alfa.server.has_viewers());
}

TEST(VideoPuller, AStationThatGivesItselfOutForAnotherIsNotBelieved) {
  Station alfa("alfa", "127.0.0.91");
  alfa.server.offer(frame_at(1));
  VideoPuller puller({"127.0.0.0/8"}, {});
  puller.watch({{{"bravo"}, alfa.address}});
  // Once it has connected again, the first picture has been judged.
  EXPECT_TRUE(
      eventually([&] { return alfa.server.report().counters.at("video_frames_sent") >= 2; }));
  EXPECT_TRUE(puller.take().empty());
}

}  // namespace
}  // namespace ols::console
