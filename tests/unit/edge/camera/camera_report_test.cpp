#include "edge/camera/camera_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conditions/alarms.h"

namespace ols::camera {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

CameraFacts streaming() {
  CameraFacts facts;
  facts.state = CameraState::kStreaming;
  facts.identity = "AVT GT1290C 1234";
  facts.opened_s = 10.0;
  facts.last_frame_s = 99.95;
  facts.frame_rate_hz = 15.0;
  facts.exposure = {.exposure_us = 800.0, .gain_dB = 3.0};
  facts.temperature_degC = 44.5;
  facts.stamp_sd_s = 30e-6;
  return facts;
}

TEST(CameraReport, OfACameraThatIsWell) {
  CameraFacts facts = streaming();
  facts.counters = {.frames_captured = 7,
                    .frames_lost = 6,
                    .frames_incomplete = 5,
                    .frames_late = 4,
                    .frames_refused = 3,
                    .reconnects = 2};
  const device::DeviceReport report = make_camera_report(CameraConfig{}, facts, 100.0);
  EXPECT_EQ(report.name, "camera");
  EXPECT_EQ(report.state, device::DeviceState::kOk);
  EXPECT_EQ(report.text, "AVT GT1290C 1234, Mono8 1280x960, 15.0 Hz");
  EXPECT_EQ(report.last_good_s, 99.95);
  EXPECT_THAT(report.alarms, IsEmpty());
  const std::map<std::string, double> readings{{"camera_exposure_us", 800.0},
                                               {"camera_gain_dB", 3.0},
                                               {"camera_degC", 44.5},
                                               {"camera_frame_rate_hz", 15.0},
                                               {"camera_clock_sd_s", 30e-6}};
  EXPECT_EQ(report.readings, readings);
  const std::map<std::string, std::uint64_t> counters{
      {"frames_captured", 7}, {"frames_lost", 6},    {"frames_incomplete", 5},
      {"frames_late", 4},     {"frames_refused", 3}, {"camera_reconnects", 2}};
  EXPECT_EQ(report.counters, counters);
}

TEST(CameraReport, SilenceIsAFaultWithinASecondAndAnAlarmIfItLasts) {
  const device::DeviceReport brief = make_camera_report(CameraConfig{}, streaming(), 99.95 + 0.7);
  EXPECT_EQ(brief.state, device::DeviceState::kFault);
  EXPECT_EQ(brief.text, "no frames for 0.7 s");
  EXPECT_THAT(brief.alarms, IsEmpty()) << "a busy computer is none";
  const device::DeviceReport report = make_camera_report(CameraConfig{}, streaming(), 99.95 + 1.6);
  EXPECT_THAT(report.alarms, ElementsAre("camera: no frames for 1.6 s"));
  CameraFacts lost = streaming();
  lost.state = CameraState::kAbsent;
  lost.last_error = "lost: no frame arrives";
  const device::DeviceReport later = make_camera_report(CameraConfig{}, lost, 99.95 + 2.1);
  EXPECT_THAT(later.alarms, ElementsAre("camera: no frames for 2.1 s"));
  EXPECT_THAT(make_camera_report(CameraConfig{}, lost, 99.95 + 1.2).alarms,
              ElementsAre("camera: no frames for 1.2 s"))
      << "the same alarm from the moment when it is given up";
  EXPECT_EQ(later.state, device::DeviceState::kAbsent);
  EXPECT_EQ(later.text, "lost: no frame arrives");
}

TEST(CameraReport, ACameraThatWaitsForATriggerIsNotLost) {
  CameraConfig config;
  config.trigger = TriggerMode::kLine1;
  const device::DeviceReport report = make_camera_report(config, streaming(), 110.02);
  EXPECT_EQ(report.state, device::DeviceState::kOk);
  EXPECT_THAT(report.alarms,
              ElementsAre("camera: no frames for 10.1 s, it is waiting for a trigger"));
}

TEST(CameraReport, OneThatWasNeverThereDoesNotAnswer) {
  EXPECT_THAT(make_camera_report(CameraConfig{}, CameraFacts{}, 100.0).alarms,
              ElementsAre("camera: does not answer"));
}

TEST(CameraReport, WhatHoldsIsAnAlarm) {
  CameraFacts facts = streaming();
  facts.stamp_source = StampSource::kArrival;
  facts.stamp_sd_s = 0.010;
  facts.incomplete_share = 0.12;
  facts.missing_light = 3.0;
  facts.ptp = PtpState::kSyncing;
  facts.ptp_disagreement_s = -1.0;
  EXPECT_THAT(make_camera_report(CameraConfig{}, facts, 100.0).alarms,
              ElementsAre("camera: time stamps are the host's, +-10 ms",
                          "camera: 12 % of the frames incomplete",
                          "camera: image too dark at the exposure and gain limits",
                          "camera: PTP is not yet synchronised",
                          "camera: PTP differs from the camera's latched clock by -1.0000 s"));
  CameraFacts unfit = streaming();
  unfit.state = CameraState::kFault;
  unfit.fault = alarm::camera_other_format("BayerRG8", "Mono8");
  EXPECT_THAT(make_camera_report(CameraConfig{}, unfit, 100.0).alarms,
              ElementsAre("camera: insists on pixel format BayerRG8 instead of Mono8"));
}

}  // namespace
}  // namespace ols::camera
