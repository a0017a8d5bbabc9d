#include "tools/doctor/judge_devices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "conditions/alarms.h"

namespace ols::doctor {
namespace {

using testing::HasSubstr;

std::string lines(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) text += line(finding) + "\n";
  return text;
}

PtuAnswers good_ptu() {
  PtuAnswers ptu;
  ptu.serial.device = "/dev/ols/ptu";
  ptu.baud = ptu.wanted_baud = 38400;
  ptu.wanted_line_baud = 9600;
  ptu.version = "Pan-Tilt Controller v2.12.1d1(C14/E), (C)2003 Directed Perception, Inc.";
  ptu.pan = {46.2857, -12369.0, 12369.0};
  ptu.tilt = {46.2857, -3650.0, 2411.0};
  ptu.environment =
      ptu::PtuEnvironment{.supply_V = 24.0, .head_degC = {}, .pan_degC = {}, .tilt_degC = {}};
  ptu.supply_min_V = 11.5;
  return ptu;
}

TEST(DoctorOnDevices, AWellPtuIsDescribedInDegrees) {
  const Findings findings = judge(good_ptu());
  EXPECT_EQ(exit_status(findings), 0) << lines(findings);
  EXPECT_THAT(lines(findings), HasSubstr("PTU-D46 v2.12.1d1(C14/E) on /dev/ols/ptu"));
  EXPECT_THAT(lines(findings), HasSubstr("pan -159.0...159.0 deg in steps of 46.29\""));
  EXPECT_THAT(lines(findings), HasSubstr("supply 24.0 V"));
}

TEST(DoctorOnDevices, AFreshUnitMayStillAnswerAtTheRateOfPowerUp) {
  PtuAnswers ptu = good_ptu();
  ptu.baud = 9600;
  EXPECT_EQ(exit_status(judge(ptu)), 0);
  ptu.baud = 19200;
  EXPECT_EQ(exit_status(judge(ptu)), 2);
  EXPECT_THAT(lines(judge(ptu)), HasSubstr("line_baud = 19200"));
}

TEST(DoctorOnDevices, ASilentPtuIsOneFailureNotMany) {
  PtuAnswers ptu = good_ptu();
  ptu.baud = 0;
  EXPECT_EQ(judge(ptu).size(), 1U);
  EXPECT_THAT(lines(judge(ptu)), HasSubstr("check its 12-30 V supply"));
}

TEST(DoctorOnDevices, AWeakSupplyWarnsAndAnUnreferencedAxisFails) {
  PtuAnswers ptu = good_ptu();
  ptu.environment->supply_V = 11.2;
  EXPECT_EQ(exit_status(judge(ptu)), 1);
  ptu.not_referenced = true;
  EXPECT_EQ(exit_status(judge(ptu)), 2);
  EXPECT_THAT(lines(judge(ptu)), HasSubstr("clear its whole travel"));
  ptu = good_ptu();
  ptu.tilt.greatest = ptu.tilt.least;
  EXPECT_THAT(lines(judge(ptu)), HasSubstr("no travel"));
  ptu.tilt.least.reset();
  EXPECT_THAT(lines(judge(ptu)), HasSubstr("tilt unknown"));
}

TEST(DoctorOnDevices, ALineThatCannotBeUsedNamesTheReason) {
  struct Case {
    int error;
    const char* advice;
  };
  for (const Case& c : {Case{ENOENT, "plug the adapter in"}, Case{EACCES, "group dialout"},
                        Case{ENOTTY, "correct the device"}, Case{EIO, "supply voltage"}}) {
    PtuAnswers ptu = good_ptu();
    ptu.serial.error = c.error;
    EXPECT_EQ(judge(ptu).size(), 1U);
    EXPECT_EQ(exit_status(judge(ptu)), 2);
    EXPECT_THAT(lines(judge(ptu)), HasSubstr(c.advice));
  }
  const SerialFacts taken{"/dev/ttyUSB0", EBUSY, {"minicom (77)"}};
  EXPECT_THAT(line(*judge_line("ptu", taken)), HasSubstr("in use by minicom (77)"));
  EXPECT_FALSE(judge_line("ptu", SerialFacts{"/dev/ttyUSB0", 0, {}}).has_value());
}

TEST(DoctorOnDevices, AReportedDeviceKeepsItsWordsAndGetsAdvice) {
  device::DeviceReport gnss{.name = "gnss",
                            .state = device::DeviceState::kOk,
                            .text = "3D, 9 satellites",
                            .serial = {},
                            .last_good_s = {},
                            .last_error = {},
                            .alarms = {},
                            .readings = {},
                            .counters = {}};
  EXPECT_EQ(line(judge(gnss)), "ok    gnss: 3D, 9 satellites");
  gnss.state = device::DeviceState::kFault;
  gnss.text = "no fix";
  gnss.last_error = "no report for 6 s";
  gnss.alarms = {alarm::gnss_fails("no fix")};
  EXPECT_THAT(line(judge(gnss)),
              HasSubstr("FAIL  gnss: no fix (no report for 6 s)  — systemctl status gpsd"));
  gnss.state = device::DeviceState::kStarting;
  EXPECT_EQ(judge(gnss).verdict, Verdict::kWarn);
  device::DeviceReport ptu = gnss;
  ptu.name = "ptu";
  ptu.state = device::DeviceState::kFault;
  ptu.alarms = {alarm::ptu_ran_into_limit()};
  EXPECT_THAT(line(judge(ptu)), HasSubstr("ols-ctl STATION home"));
  EXPECT_THAT(line(judge(ptu)), HasSubstr("ols-ctl STATION reference-ok"));
}

CameraAnswers good_camera() {
  CameraAnswers camera;
  camera.device = "169.254.10.2";
  camera.identity = "AVT GT1290C 1234";
  camera.link = LinkFacts{"eth1", true, 9000, 1000, 100000, 0};
  camera.rate_bytes_s = 1280.0 * 960.0 * 15.0;
  return camera;
}

TEST(DoctorOnDevices, AWellCameraOnAGoodLink) {
  EXPECT_EQ(exit_status(judge(good_camera())), 0) << lines(judge(good_camera()));
}

TEST(DoctorOnDevices, AMissingCameraNamesThoseThatAnswer) {
  CameraAnswers camera = good_camera();
  camera.trouble = "169.254.10.2 does not answer: timeout";
  camera.others = {"AVT-1 at 169.254.10.3"};
  EXPECT_THAT(lines(judge(camera)), HasSubstr("these answer: AVT-1 at 169.254.10.3"));
  EXPECT_EQ(exit_status(judge(camera)), 2);
}

TEST(DoctorOnDevices, ACameraWithoutAClockOrInOtherHandsIsTold) {
  CameraAnswers camera = good_camera();
  camera.has_clock = false;
  EXPECT_EQ(exit_status(judge(camera)), 1);
  EXPECT_THAT(lines(judge(camera)), HasSubstr("stamped on arrival"));
  camera.controlled = true;
  EXPECT_EQ(exit_status(judge(camera)), 2);
}

TEST(DoctorOnDevices, ALinkTooSlowTooNarrowOrLossyIsTold) {
  const double stream = good_camera().rate_bytes_s;  // 147 Mbit/s
  EXPECT_EQ(exit_status(judge(LinkFacts{"eth1", true, 1500, 1000, 100000, 5}, stream)), 0);
  EXPECT_EQ(exit_status(judge(LinkFacts{"eth1", true, 1500, 100, 100000, 0}, stream)), 2);
  EXPECT_EQ(exit_status(judge(LinkFacts{"eth1", true, 1400, 1000, 100000, 0}, stream)), 1);
  EXPECT_EQ(exit_status(judge(LinkFacts{"eth1", true, 1500, 1000, 100000, 50}, stream)), 1);
  EXPECT_EQ(exit_status(judge(LinkFacts{"eth1", false, 1500, {}, 0, 0}, stream)), 2);
  EXPECT_EQ(exit_status(judge(LinkFacts{}, stream)), 2);
}

TEST(MeasuredMount, TheResultOfTheMeasurementIsShownOrHowToGetIt) {
  EXPECT_EQ(
      judge_measured_mount("2026-12-01 04:10 UTC, written\npan: gain 1\ntilt: gain 2\n", "alfa")
          .what,
      "mount: measured by ols-calibrate mount; 2026-12-01 04:10 UTC, written; pan: gain 1; "
      "tilt: gain 2");
  EXPECT_NE(judge_measured_mount("", "alfa").what.find("ols-calibrate mount --station alfa"),
            std::string::npos);
}

TEST(MeasuredMount, PicturesOfAnotherHostAreNamed) {
  EXPECT_FALSE(judge_hosts("10.0.0.5", "10.0.0.5"));
  const auto other = judge_hosts("10.0.0.6", "10.0.0.5");
  ASSERT_TRUE(other);
  EXPECT_EQ(other->verdict, Verdict::kWarn);
  EXPECT_EQ(other->what, "mount: at 10.0.0.5, but the pictures come from 10.0.0.6");
}

}  // namespace
}  // namespace ols::doctor
