// A station's RTSP camera against a simulated one on the wire.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "edge/camera/rtsp/rtsp_camera.h"
#include "sim/camera/rtsp_server.h"
#include "sim/camera/time_in_picture.h"
#include "tests/unit/edge/device/made_certificate.h"
#include "tests/unit/sim/camera/camera_rig.h"
#include "tests/unit/temporary_folder.h"

namespace ols {
namespace {

using camera::StampSource;
using testing::HasSubstr;

// Noise, and the middle of the exposure.
void draw_noise_and_time(const sim::Exposure& exposure, cv::Mat& picture) {
  static std::mt19937 random(1);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; x += 4)
      *picture.ptr<std::uint32_t>(y, x) = 0x70707070U + (random() & 0x0f0f0f0fU);
  sim::draw_time(exposure.start_monotonic_ns / 1000 + std::llround(0.5e6 * exposure.exposure_s),
                 picture);
}

double time_in(const camera::Frame& frame) {
  return 1e-6 * static_cast<double>(sim::time_in(frame.gray));
}

sim::RtspServerConfig server_config() {
  sim::RtspServerConfig config;
  config.address = "127.0.0.1";
  config.port = 0;
  config.width_px = kWidth;
  config.height_px = kHeight;
  return config;
}

camera::RtspConfig camera_config(const std::string& url) {
  camera::RtspConfig config;
  config.url = url;
  config.width_px = kWidth;
  config.height_px = kHeight;
  config.frame_rate_hz = 25.0;
  config.clock.delay_s = 0.06;
  config.clock.delay_sd_s = 0.05;
  config.no_frame_timeout_s = 1.0;
  return config;
}

struct Wire {
  explicit Wire(
      const sim::RtspServerConfig& config = server_config(),
      const std::function<void(const sim::Exposure&, cv::Mat&)>& paint = draw_noise_and_time)
      : server(config, paint) {}
  void connect(const camera::RtspConfig& config) {
    camera = std::make_unique<camera::RtspCamera>(config);
  }
  // The next frame for which this holds.
  std::optional<camera::Frame> await(const std::function<bool(const camera::Frame&)>& good) {
    const double until_s = clock_s(CLOCK_MONOTONIC) + kDeadline_s;
    while (clock_s(CLOCK_MONOTONIC) < until_s)
      if (auto frame = camera->next(0.1); frame && good(*frame)) return frame;
    return std::nullopt;
  }
  bool await_report(const std::function<bool(const device::DeviceReport&)>& good) {
    const double until_s = clock_s(CLOCK_MONOTONIC) + kDeadline_s;
    while (clock_s(CLOCK_MONOTONIC) < until_s) {
      if (good(camera->report())) return true;
      camera->next(0.02);
    }
    return false;
  }
  sim::RtspServer server;
  std::unique_ptr<camera::RtspCamera> camera;
};

bool any(const camera::Frame&) { return true; }

TEST(RtspWire, EveryCodecGivesPicturesWithTheirTimes) {
  for (const auto& [codec, transport, colour] :
       {std::tuple{sim::VideoCodec::kH264, camera::RtspTransport::kUdp, true},
        std::tuple{sim::VideoCodec::kH265, camera::RtspTransport::kTcp, true},
        std::tuple{sim::VideoCodec::kJpeg, camera::RtspTransport::kTcp, false}}) {
    auto config = server_config();
    config.codec = codec;
    Wire wire(config);
    auto station = camera_config(wire.server.url());
    station.transport = transport;
    station.keep_raw = colour;
    station.row_readout_s = 0.02;
    wire.connect(station);
    const auto first = wire.await(any);
    ASSERT_TRUE(first) << static_cast<int>(codec) << wire.camera->report().text;
    EXPECT_EQ(first->stamp_source, StampSource::kArrival);
    EXPECT_NEAR(first->stamp_sd_s, 0.05, 0.01);
    const auto frame =
        wire.await([](const camera::Frame& f) { return f.stamp_source == StampSource::kCamera; });
    ASSERT_TRUE(frame) << static_cast<int>(codec) << wire.camera->report().text;
    EXPECT_NEAR(frame->mid_exposure_s, time_in(*frame), 0.001);
    EXPECT_EQ(frame->gray.size(), cv::Size(kWidth, kHeight));
    EXPECT_EQ(frame->raw.channels() == 3, colour);
    EXPECT_EQ(frame->row_readout_s, 0.02);
    EXPECT_THAT(wire.camera->report().text, HasSubstr("times by sender reports"));
  }
}

TEST(RtspWire, ReportsOfLocalTimeAreSaidAndNotBelieved) {
  Wire wire;
  wire.server.set_faults({.clock_off_s = 7200.0});
  wire.connect(camera_config(wire.server.url()));
  EXPECT_TRUE(wire.await_report([](const device::DeviceReport& report) {
    return std::ranges::any_of(report.alarms,
                               [](const Alarm& a) { return a.id == "camera_reports_refused"; });
  }));
  const auto frame = wire.await(any);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp_source, StampSource::kArrival);
}

TEST(RtspWire, ReportsOfAClockThatDriftsAwayAreSaidAndNotBelieved) {
  Wire wire;
  wire.server.set_faults({.clock_drift = 0.1});
  wire.connect(camera_config(wire.server.url()));
  EXPECT_TRUE(wire.await_report([](const device::DeviceReport& report) {
    return std::ranges::any_of(report.alarms,
                               [](const Alarm& a) { return a.id == "camera_reports_refused"; });
  }));
  const auto frame = wire.await(any);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp_source, StampSource::kArrival);
  EXPECT_NEAR(frame->mid_exposure_s, time_in(*frame), 0.1);
}

TEST(RtspWire, ACameraThatComesBackIsConnectedAgain) {
  Wire wire;
  wire.connect(camera_config(wire.server.url()));
  const auto before = wire.await(any);
  ASSERT_TRUE(before);
  wire.server.set_faults({.gone = true});
  ASSERT_TRUE(
      wire.await_report([](const auto& r) { return r.state == device::DeviceState::kAbsent; }));
  wire.server.set_faults({});
  const auto after = wire.await(
      [&](const camera::Frame& f) { return f.mid_exposure_s > before->mid_exposure_s + 1.0; });
  ASSERT_TRUE(after);
  EXPECT_GT(after->number, before->number);
  EXPECT_GE(wire.camera->report().counters.at("camera_reconnects"), 1U);
}

TEST(RtspWire, AnotherSizeIsRefusedUntilItIsTheOldOneAgain) {
  Wire wire;
  wire.connect(camera_config(wire.server.url()));
  ASSERT_TRUE(wire.await(any));
  wire.server.set_size(2 * kWidth, 2 * kHeight);
  ASSERT_TRUE(wire.await_report([](const auto& r) {
    return r.state == device::DeviceState::kFault && r.counters.at("frames_refused") > 3;
  }));
  wire.server.set_size(kWidth, kHeight);
  EXPECT_TRUE(wire.await_report([](const auto& r) { return r.state == device::DeviceState::kOk; }));
}

TEST(RtspWire, AFrozenPictureIsNotUsed) {
  std::atomic<bool> frozen = false;
  cv::Mat last;
  Wire wire(server_config(), [&](const sim::Exposure& exposure, cv::Mat& picture) {
    if (!frozen) draw_noise_and_time(exposure, last = cv::Mat(picture.size(), CV_8U));
    last.copyTo(picture);
  });
  auto station = camera_config(wire.server.url());
  station.frozen_s = 1.5;
  wire.connect(station);
  ASSERT_TRUE(wire.await(any));
  frozen = true;
  ASSERT_TRUE(wire.await_report([](const auto& r) {
    return r.last_error.find("the same picture") != std::string::npos;
  })) << wire.camera->report().text;
  frozen = false;
  EXPECT_TRUE(wire.await_report([](const auto& r) { return r.state == device::DeviceState::kOk; }));
}

TEST(RtspWire, AWrongPasswordIsTriedOnceAndARightOneAtOnce) {
  const std::string file = std::string("/tmp/rtsp_password.") + std::to_string(::getpid());
  std::ofstream(file) << "wrong\n";
  auto config = server_config();
  config.user = "admin";
  config.password = "right";
  Wire wire(config);
  auto station = camera_config(wire.server.url());
  station.user = "admin";
  station.password_file = file;
  wire.connect(station);
  const auto refused = [](const device::DeviceReport& report) {
    return std::ranges::any_of(report.alarms,
                               [](const Alarm& a) { return a.id == "camera_refuses_login"; });
  };
  ASSERT_TRUE(wire.await_report(refused)) << wire.camera->report().text;
  const int connections = wire.server.connections();
  EXPECT_LE(connections, 2);
  for (int i = 0; i < 30; ++i) wire.camera->next(0.1);
  EXPECT_EQ(wire.server.connections(), connections);
  EXPECT_TRUE(refused(wire.camera->report()));
  std::ofstream(file) << "right\n";
  EXPECT_TRUE(wire.await(any)) << wire.camera->report().text;
  std::filesystem::remove(file);
}

// The certificate is the camera's own, has expired, and is for another host.
TEST(RtspWire, ACertificateIsRefusedWithItsKeyAndTakenOnceThatIsPinned) {
  const auto certificate = device::made_certificate("camera", -1);
  auto config = server_config();
  config.user = "admin";
  config.password = "right";
  config.certificate = certificate.pem;
  Wire wire(config);
  const TemporaryFolder folder;
  auto station = camera_config(wire.server.url());
  station.user = "admin";
  station.password_file = folder / "password";
  std::ofstream(station.password_file) << "right\n";
  const auto refusal_of = [&](const std::string& pin) {
    station.pinned_key = pin;
    wire.connect(station);
    wire.await_report([](const device::DeviceReport& report) {
      return std::ranges::any_of(report.alarms,
                                 [](const Alarm& a) { return a.id == "camera_certificate"; });
    });
    return wire.camera->report().text;
  };
  const std::string why = refusal_of("");
  for (const char* words : {"nobody whom this system trusts", "another host", "expired"})
    EXPECT_THAT(why, HasSubstr(words));
  EXPECT_THAT(why, HasSubstr("its key is " + certificate.pin));
  EXPECT_THAT(refusal_of(device::made_certificate("camera").pin), HasSubstr("not pinned_key"));
  station.pinned_key = certificate.pin;
  wire.connect(station);
  EXPECT_TRUE(wire.await(any)) << wire.camera->report().text;
}

TEST(RtspWire, LostPacketsGiveNoSmearedPictures) {
  Wire wire;
  wire.connect(camera_config(wire.server.url()));
  ASSERT_TRUE(wire.await(any));
  wire.server.set_faults({.packet_loss = 0.01});
  ASSERT_TRUE(wire.await_report([](const auto& r) {
    return r.counters.at("frames_incomplete") > 20 && r.counters.at("camera_packets_lost") > 3;
  }));
  for (int i = 0; i < 10; ++i) {
    const auto frame = wire.await(any);
    ASSERT_TRUE(frame);
    EXPECT_NEAR(time_in(*frame), frame->mid_exposure_s, 0.3);
  }
}

TEST(RtspWire, ALyingRateIsMeasuredAndSaid) {
  Wire wire;
  wire.server.set_faults({.missing_rate = 0.16});
  wire.connect(camera_config(wire.server.url()));
  EXPECT_TRUE(wire.await_report([](const device::DeviceReport& report) {
    return std::ranges::any_of(report.alarms,
                               [](const Alarm& a) { return a.id == "camera_stamps_run_wrong"; }) &&
           std::ranges::any_of(report.alarms,
                               [](const Alarm& a) { return a.id == "camera_rate_differs"; });
  }));
  const auto frame = wire.await(any);
  ASSERT_TRUE(frame);
  EXPECT_NEAR(time_in(*frame), frame->mid_exposure_s, 0.25);
}

}  // namespace
}  // namespace ols
