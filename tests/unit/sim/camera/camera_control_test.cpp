// Triggers, exposure, clocks and faults of the station's camera, over the real wire and with either
// set of feature names.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/unit/sim/camera/camera_rig.h"

namespace ols {
namespace {

using sim::gige::FeatureNames;

class CameraControl : public testing::TestWithParam<FeatureNames> {
 protected:
  Serve as() const { return {.names = GetParam()}; }
};
INSTANTIATE_TEST_SUITE_P(Names, CameraControl,
                         testing::Values(FeatureNames::kGt1290c, FeatureNames::kSfnc),
                         [](const auto& named) {
                           return named.param == FeatureNames::kGt1290c ? "Gt1290c" : "Sfnc";
                         });

// Between the exposures of two frames that follow each other.
double period_s(camera::AravisCamera& camera) {
  auto last = frame_of(camera);
  for (int i = 0; last && i < 200; ++i) {
    auto next = frame_of(camera);
    if (!next) break;
    const bool neighbours = exposure_of(*next).frame == exposure_of(*last).frame + 1;
    if (neighbours) return true_middle_s(*next) - true_middle_s(*last);
    last = std::move(next);
  }
  return NAN;
}

TEST_P(CameraControl, RateExposureAndGainAreThoseThatAreSet) {
  const auto server = serve(as());
  camera::AravisConfig config = station_camera();
  config.exposure_us = 1500.0;
  config.gain_dB = 6.0;
  camera::AravisCamera camera(config);
  EXPECT_NEAR(period_s(camera), 1.0 / 20.0, 1e-3);
  const auto frame = frame_of(camera);
  ASSERT_TRUE(frame) << camera.facts().last_error;
  EXPECT_NEAR(exposure_of(*frame).exposure_s, 1500e-6, 1e-9);
  EXPECT_NEAR(exposure_of(*frame).gain_dB, 6.0, 1e-6);
  auto readings = camera.report().readings;
  EXPECT_NEAR(readings["camera_exposure_us"], 1500.0, 1e-3);
  EXPECT_NEAR(readings["camera_gain_dB"], 6.0, 1e-6);
  EXPECT_NEAR(readings["camera_degC"], 41.0, 1e-6);
  EXPECT_LT(std::abs(frame->mid_exposure_s - true_middle_s(*frame)),
            4.0 * frame->stamp_sd_s + 1e-3);
}

TEST_P(CameraControl, FreeRunIsAsFastAsTheCameraCan) {
  const auto server = serve(as());
  camera::AravisConfig config = station_camera();
  config.trigger = camera::TriggerMode::kFreeRun;
  config.frame_rate_hz = 2.0;
  camera::AravisCamera camera(config);
  EXPECT_NEAR(period_s(camera), 1.0 / 33.0, 1e-3);
}

TEST_P(CameraControl, ASoftwareTriggerMakesOneFrame) {
  const auto server = serve(as());
  camera::AravisConfig config = station_camera();
  config.trigger = camera::TriggerMode::kSoftware;
  config.no_frame_timeout_s = 0.1;
  camera::AravisCamera camera(config);
  ASSERT_TRUE(becomes(camera, [&] { return has_alarm(camera, "waiting for a trigger"); }));
  EXPECT_EQ(camera.facts().counters.frames_captured, 0U);
  for (std::uint64_t i = 1; i <= 3; ++i) {
    const double asked_s = clock_s(CLOCK_MONOTONIC);
    std::optional<camera::Frame> frame;
    // As long as it is busy with the last frame the camera takes no trigger.
    ASSERT_TRUE(becomes(camera, [&] {
      camera.trigger();
      frame = camera.next(1.0);
      return frame.has_value();
    }));
    EXPECT_GE(true_middle_s(*frame), asked_s);
    EXPECT_EQ(camera.facts().counters.frames_captured, i);
  }
  EXPECT_EQ(camera.facts().counters.reconnects, 0U);
}

TEST_P(CameraControl, APulseOnItsLineMakesAFrameAfterTheDelay) {
  const auto server = serve(as());
  camera::AravisConfig config = station_camera();
  config.trigger = camera::TriggerMode::kLine2;
  config.trigger_delay_us = 30'000.0;
  config.no_frame_timeout_s = 0.1;
  camera::AravisCamera camera(config);
  ASSERT_TRUE(becomes(camera, [&] { return has_alarm(camera, "waiting for a trigger"); }));
  server->pulse(1);  // another line's
  EXPECT_FALSE(camera.next(0.3));
  const double pulse_s = clock_s(CLOCK_MONOTONIC);
  server->pulse(2);
  const auto frame = frame_of(camera);
  ASSERT_TRUE(frame) << camera.facts().last_error;
  EXPECT_GE(true_middle_s(*frame), pulse_s + 0.030);
  EXPECT_LT(std::abs(frame->mid_exposure_s - true_middle_s(*frame)),
            4.0 * frame->stamp_sd_s + 1e-3);
  EXPECT_EQ(camera.facts().counters.reconnects, 0U);
}

TEST_P(CameraControl, AutomaticExposureSettlesAndEveryFrameKnowsItsMiddle) {
  Serve how = as();
  how.paint = [](const sim::Exposure& exposure, cv::Mat& picture) {
    const double light = exposure.exposure_s / 1e-3 * std::pow(10.0, exposure.gain_dB / 20.0);
    picture.setTo(cv::Scalar(5.0 * light));
    sign(exposure, picture);
  };
  const auto server = serve(how);
  camera::AravisConfig config = station_camera();
  config.exposure_us = 500.0;
  config.auto_exposure = true;
  config.limits.exposure_max_us = 8000.0;
  camera::AravisCamera camera(config);
  const double end_s = clock_s(CLOCK_MONOTONIC) + kDeadline_s;
  double level = 0.0;
  while (std::abs(level - 110.0) > 20.0 && clock_s(CLOCK_MONOTONIC) < end_s) {
    const auto frame = frame_of(camera);
    ASSERT_TRUE(frame) << camera.facts().last_error;
    level = frame->gray.at<std::uint8_t>(100, 100);
    EXPECT_LT(std::abs(frame->mid_exposure_s - true_middle_s(*frame)),
              4.0 * frame->stamp_sd_s + 1e-3)
        << "exposure " << exposure_of(*frame).exposure_s;
  }
  EXPECT_NEAR(level, 110.0, 20.0);
  auto readings = camera.report().readings;
  EXPECT_DOUBLE_EQ(readings["camera_exposure_us"], 8000.0);  // gain comes after exposure
  EXPECT_GT(readings["camera_gain_dB"], 5.0);
}

TEST_P(CameraControl, ItsClockMayBecomeThatOfAPtpMaster) {
  const auto server = serve(as());
  camera::AravisConfig config = station_camera();
  config.ptp = "slave";
  camera::AravisCamera camera(config);
  EXPECT_TRUE(becomes(camera, [&] { return has_alarm(camera, "PTP is not yet synchronised"); }));
  // It steps from its own epoch to TAI; the frames around the step are the arrivals' to tell.
  EXPECT_TRUE(becomes(camera, [&] { return !has_alarm(camera, "camera: PTP"); }));
  EXPECT_TRUE(becomes(camera, [&] {
    const auto frame = camera.next(1.0);
    return frame && frame->stamp_sd_s < 1e-3 &&
           std::abs(frame->mid_exposure_s - true_middle_s(*frame)) < 2e-3;
  }));
}

TEST_P(CameraControl, PacedPacketsFitASmallBuffer) {
  Serve how = as();
  how.width_px = 1280;
  how.height_px = 960;
  const auto server = serve(how);
  camera::AravisConfig config = station_camera();
  config.width_px = 1280;
  config.height_px = 960;
  config.frame_rate_hz = 5.0;  // a packet each 1.5 ms
  config.packet_size = 9000;
  config.packet_resend = false;
  config.socket_buffer = 200'000;  // a sixth of a frame; sent in one go hardly a frame is complete
  camera::AravisCamera camera(config);
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().counters.frames_captured >= 15; }))
      << camera.facts().counters.frames_incomplete << " incomplete";
}

TEST(CameraClock, WithoutATickFrequencyTheStampsAreMarkedAsTheHosts) {
  const auto server = serve({.tick_frequency = false});
  camera::AravisCamera camera(station_camera());
  const auto frame = frame_of(camera);
  ASSERT_TRUE(frame) << camera.facts().last_error;
  EXPECT_EQ(frame->stamp_source, camera::StampSource::kArrival);
  EXPECT_DOUBLE_EQ(frame->stamp_sd_s, camera::AravisConfig{}.readout_sd_s);
  EXPECT_TRUE(has_alarm(camera, "camera: time stamps are the host's, +-10 ms"));
}

TEST(CameraLoss, ACameraThatWasOffAndOnIsOpenedAgain) {
  const auto server = serve();
  camera::AravisCamera camera(station_camera());
  ASSERT_TRUE(frame_of(camera)) << camera.facts().last_error;
  server->power_cycle();
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().counters.reconnects >= 1; }));
  EXPECT_TRUE(
      becomes(camera, [&] { return camera.facts().state == camera::CameraState::kStreaming; }));
}

// No silence tells it here: only the heartbeat does.
TEST(CameraLoss, ALostControlIsNoticedWithoutAnyFrame) {
  const auto server = serve();
  camera::AravisConfig config = station_camera();
  config.trigger = camera::TriggerMode::kLine1;
  camera::AravisCamera camera(config);
  ASSERT_TRUE(
      becomes(camera, [&] { return camera.facts().state == camera::CameraState::kStarting; }));
  server->power_cycle();
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().counters.reconnects >= 1; }));
  EXPECT_EQ(camera.facts().last_error, "lost: it no longer answers");
  EXPECT_TRUE(becomes(camera, [&] {
    server->pulse(1);
    return camera.next(0.2).has_value();
  }));
}

TEST(CameraLoss, SilenceIsReportedBeforeTheCameraIsGivenUp) {
  const auto server = serve();
  camera::AravisConfig config = station_camera();
  config.no_frame_timeout_s = 5.0;
  camera::AravisCamera camera(config);
  ASSERT_TRUE(frame_of(camera)) << camera.facts().last_error;
  server->set_faults({.gone = true, .pixel_format = {}});
  EXPECT_TRUE(becomes(camera, [&] { return has_alarm(camera, "camera: no frames for"); }));
  EXPECT_EQ(camera.report().state, device::DeviceState::kFault);
  EXPECT_EQ(camera.facts().counters.reconnects, 0U);
}

}  // namespace
}  // namespace ols
