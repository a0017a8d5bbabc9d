#include "edge/video/video_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/eventually.h"
#include "video_viewer.h"

namespace ols::video {
namespace {

VideoFrame frame_at(std::int64_t utime_us) {
  VideoFrame frame;
  frame.utime_us = utime_us;
  frame.gray = cv::Mat(96, 128, CV_8U, cv::Scalar(100));
  return frame;
}

struct VideoServerTest : testing::Test {
  VideoServerTest() { start({"127.0.0.0/8"}); }

  void start(const std::vector<std::string>& allow) {
    server.reset();
    config.address = "127.0.0.1:" + std::to_string(port);
    config.allow = allow;
    server = std::make_unique<VideoServer>(config, VideoSender{"alfa", 42});
    EXPECT_TRUE(eventually([&] { return server->report().state == device::DeviceState::kOk; }));
  }
  std::uint64_t counter(const char* name) { return server->report().counters.at(name); }

  const unsigned short port = free_port();
  VideoConfig config;
  std::unique_ptr<VideoServer> server;
};

TEST_F(VideoServerTest, ItsReportSaysWhereItListens) {
  EXPECT_EQ(server->report().name, "video");
  EXPECT_EQ(server->report().text, config.address);
}

TEST_F(VideoServerTest, ARequestIsAnsweredByTheNewestFrame) {
  server->offer(frame_at(1));
  server->offer(frame_at(2));
  Viewer viewer(port);
  viewer.ask();
  EXPECT_EQ(viewer.receive().value().utime, 2);
}

TEST_F(VideoServerTest, AViewerWaitsForAFrameThatItHasNotHad) {
  server->offer(frame_at(1));
  Viewer viewer(port);
  viewer.ask();
  ASSERT_EQ(viewer.receive().value().utime, 1);
  viewer.ask(1);
  ASSERT_TRUE(eventually([&] { return counter("video_requests") == 2; }));
  EXPECT_EQ(counter("video_frames_sent"), 1U);
  server->offer(frame_at(2));
  EXPECT_EQ(viewer.receive().value().utime, 2);
}

TEST_F(VideoServerTest, NothingQueuesForASlowViewer) {
  Viewer viewer(port);
  ASSERT_TRUE(eventually([&] { return server->has_viewers(); }));
  for (int i = 1; i <= 100; ++i) server->offer(frame_at(i));
  viewer.ask();
  EXPECT_EQ(viewer.receive().value().utime, 100);
  EXPECT_EQ(counter("video_frames_sent"), 1U);
}

TEST_F(VideoServerTest, AViewerGetsAFrameOnceHoweverItAsks) {
  server->offer(frame_at(1));
  Viewer viewer(port);
  viewer.ask(0);
  ASSERT_EQ(viewer.receive().value().utime, 1);
  viewer.ask(0, 64);  // the camera stands still
  ASSERT_TRUE(eventually([&] { return counter("video_requests") == 2; }));
  server->offer(frame_at(2));
  EXPECT_EQ(viewer.receive().value().utime, 2);
  EXPECT_EQ(counter("video_frames_sent"), 2U);
}

TEST_F(VideoServerTest, EachViewerGetsTheSizeThatItAskedFor) {
  server->offer(frame_at(1));
  Viewer wide(port), narrow(port);
  wide.ask(0, 640);
  narrow.ask(0, 64);
  EXPECT_DOUBLE_EQ(wide.receive().value().scale, 1.0);
  EXPECT_DOUBLE_EQ(narrow.receive().value().scale, 0.5);
}

TEST_F(VideoServerTest, StrangersAreTurnedAwayAndCounted) {
  start({"10.0.0.0/8"});
  server->offer(frame_at(1));
  Viewer stranger(port);
  stranger.ask();
  EXPECT_FALSE(stranger.receive());
  EXPECT_TRUE(eventually([&] { return counter("video_turned_away") == 1; }));
  EXPECT_FALSE(server->has_viewers());
}

TEST_F(VideoServerTest, NoMoreViewersThanItCanServe) {
  server->offer(frame_at(1));
  std::vector<std::unique_ptr<Viewer>> viewers;
  for (int i = 0; i < VideoServer::kMaxViewers; ++i) {
    viewers.push_back(std::make_unique<Viewer>(port));
    viewers.back()->ask();
    ASSERT_TRUE(viewers.back()->receive()) << i;
  }
  Viewer late(port);
  late.ask();
  EXPECT_FALSE(late.receive());
  viewers.pop_back();  // one leaves, and there is room again
  EXPECT_TRUE(eventually([&] {
    Viewer next(port);
    next.ask();
    return next.receive().has_value();
  }));
}

TEST_F(VideoServerTest, AnAddressThatIsTakenIsAnAlarmAndIsRetried) {
  VideoServer second(config, {"alfa", 43});
  ASSERT_TRUE(eventually([&] { return !second.report().alarms.empty(); }));
  EXPECT_THAT(second.report().alarms.front(),
              testing::HasSubstr("video: cannot listen on 127.0.0.1:"));
  second.offer(frame_at(1));  // harmless
  server.reset();
  EXPECT_TRUE(eventually([&] { return second.report().state == device::DeviceState::kOk; }));
}

}  // namespace
}  // namespace ols::video
