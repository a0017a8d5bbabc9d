// A session through the sockets of its viewer and itself, in one thread.
#include "edge/video/video_session.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <string>

#include "video_viewer.h"

namespace ols::video {
namespace {

using boost::asio::ip::make_address;
using boost::asio::ip::tcp;

struct VideoSessionTest : testing::Test {
  VideoSessionTest() : acceptor(io, {make_address("127.0.0.1"), 0}) {
    viewer.emplace(acceptor.local_endpoint().port());
    session = std::make_shared<VideoSession>(
        acceptor.accept(),
        VideoSession::Callbacks{[this](VideoSession&) { ++asked; },
                                [this](VideoSession&, VideoSession::End how) { end = how; }});
    session->begin();
  }

  template <typename Condition>
  bool until(Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition() && std::chrono::steady_clock::now() < deadline) {
      io.run_for(std::chrono::milliseconds(10));
      io.restart();
    }
    return condition();
  }

  boost::asio::io_context io;
  tcp::acceptor acceptor;
  std::optional<Viewer> viewer;
  std::shared_ptr<VideoSession> session;
  int asked = 0;
  std::optional<VideoSession::End> end;
};

TEST_F(VideoSessionTest, ItWaitsForItsAnswerAndThenAsksAgain) {
  viewer->ask(5);
  ASSERT_TRUE(until([&] { return asked == 1; }));
  ASSERT_TRUE(session->request());
  EXPECT_EQ(session->request()->after_utime_us, 5);
  session->answer(std::make_shared<std::vector<std::uint8_t>>(3, 0));
  EXPECT_FALSE(session->request());
  viewer->ask(6);
  ASSERT_TRUE(until([&] { return asked == 2; }));
  EXPECT_EQ(session->request()->after_utime_us, 6);
  EXPECT_FALSE(end);
}

TEST_F(VideoSessionTest, AViewerThatLeavesWhileItWaitsIsNoticed) {
  viewer->ask();
  ASSERT_TRUE(until([&] { return asked == 1; }));
  viewer.reset();
  ASSERT_TRUE(until([&] { return end.has_value(); }));
  EXPECT_EQ(*end, VideoSession::End::kGone);
}

TEST_F(VideoSessionTest, OneThatDoesNotWaitForItsAnswerIsEnded) {
  viewer->ask();
  ASSERT_TRUE(until([&] { return asked == 1; }));
  viewer->ask();
  ASSERT_TRUE(until([&] { return end.has_value(); }));
  EXPECT_EQ(*end, VideoSession::End::kMalformed);
}

TEST_F(VideoSessionTest, WhatIsNoRequestEndsIt) {
  viewer->send(std::string("GET / HTTP/1.1\r\n\r\n"));
  ASSERT_TRUE(until([&] { return end.has_value(); }));
  EXPECT_EQ(*end, VideoSession::End::kMalformed);
}

TEST_F(VideoSessionTest, ARequestOfTheRightLengthMayStillBeNone) {
  viewer->send(length_prefix(8));
  viewer->send(std::string("nonsense"));
  ASSERT_TRUE(until([&] { return end.has_value(); }));
  EXPECT_EQ(*end, VideoSession::End::kMalformed);
  EXPECT_EQ(asked, 0);
}

}  // namespace
}  // namespace ols::video
