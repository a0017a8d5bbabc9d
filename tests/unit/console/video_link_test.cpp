#include "console/video_link.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <functional>

#include "ols_msg/video_stream_request_t.hpp"

namespace ols::console {
namespace {

using boost::asio::ip::make_address;
using boost::asio::ip::tcp;
using Bytes = std::vector<std::uint8_t>;

// A link and its peer in one thread; the peer answers each request with `answer`.
struct VideoLinkTest : testing::Test {
  VideoLinkTest() : acceptor(io, {make_address("127.0.0.1"), 0}) { accept(); }
  ~VideoLinkTest() override {
    if (link) link->end();
  }

  void begin(std::function<std::optional<std::int64_t>(Bytes)> take) {
    link = std::make_shared<VideoLink>(io, acceptor.local_endpoint(), wish, std::move(take));
    link->begin();
  }
  void accept() {
    acceptor.async_accept([this](const boost::system::error_code& error, tcp::socket next) {
      if (error) return;
      ++connections;
      peer.emplace(std::move(next));
      serve();
      accept();
    });
  }
  void serve() {
    boost::asio::async_read(*peer, boost::asio::buffer(prefix),
                            [this](const boost::system::error_code& error, std::size_t) {
                              if (error) return;
                              request.resize(message_length(prefix, 1000).value_or(0));
                              note_key();
                              boost::system::error_code failed;
                              boost::asio::read(*peer, boost::asio::buffer(request), failed);
                              boost::asio::write(*peer, boost::asio::buffer(answer), failed);
                              ++requests;
                              if (!failed) serve();
                            });
  }
  void note_key() {
    ols_msg::video_stream_request_t asked;
    const auto size = static_cast<int>(request.size());
    if (asked.decode(request.data(), 0, size) == size) keys.push_back(asked.key_frame != 0);
  }
  template <typename Condition>
  bool until(Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition() && std::chrono::steady_clock::now() < deadline) {
      io.run_for(std::chrono::milliseconds(5));
      io.restart();
    }
    return condition();
  }

  boost::asio::io_context io;
  tcp::acceptor acceptor;
  std::optional<tcp::socket> peer;
  std::shared_ptr<VideoLink> link;
  VideoWish wish;
  std::vector<bool> keys;  // of a stream: which requests were for a key frame
  LengthPrefix prefix{};
  Bytes request, answer = {0, 0, 0, 2, 7, 8};
  int connections = 0, requests = 0, taken = 0;
};

TEST_F(VideoLinkTest, AsksAgainAsSoonAsItHasAnAnswer) {
  begin([this](const Bytes& bytes) {
    EXPECT_EQ(bytes, (Bytes{7, 8}));
    return ++taken;
  });
  EXPECT_TRUE(until([this] { return taken >= 3; }));
  EXPECT_EQ(connections, 1);
}

TEST_F(VideoLinkTest, ConnectsAgainAfterAnAnswerThatIsNone) {
  answer = {0xff, 0xff, 0xff, 0xff};
  begin([](const Bytes&) { return 1; });
  EXPECT_TRUE(until([this] { return connections == 2; }));
}

TEST_F(VideoLinkTest, ConnectsAgainAfterAPictureThatNobodyWants) {
  begin([](const Bytes&) { return std::nullopt; });
  EXPECT_TRUE(until([this] { return connections == 2; }));
}

TEST_F(VideoLinkTest, AsksForAKeyFrameOfAStreamAtItsBeginningAndFromTimeToTime) {
  wish.codec = Codec::kH264;
  begin([this](const Bytes&) { return ++taken; });
  const std::size_t many = 2 * kUnitsOfKeyFrame + 1;
  ASSERT_TRUE(until([&] { return keys.size() >= many; }));
  for (std::size_t i = 0; i < many; ++i) EXPECT_EQ(keys[i], i % kUnitsOfKeyFrame == 0) << i;
}

TEST_F(VideoLinkTest, CallsNothingAfterItsEnd) {
  begin([this](const Bytes&) { return ++taken; });
  ASSERT_TRUE(until([this] { return taken >= 1; }));
  link->end();
  const int before = taken;
  io.run_for(std::chrono::milliseconds(50));
  EXPECT_EQ(taken, before);
}

}  // namespace
}  // namespace ols::console
