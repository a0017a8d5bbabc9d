#include "edge/ptu/ptu_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::ptu {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

PtuStatus good() {
  PtuStatus status;
  status.state = PtuState::kReady;
  status.port.open = true;
  status.line_baud = 38400;
  status.last_good_s = 100.0;
  status.firmware = "Pan-Tilt Controller v2.12.1d1(C14/E), (C)2003 DP";
  status.environment = PtuEnvironment{24.0, 30.0, {}, {}};
  return status;
}

TEST(PtuReport, OfAUnitThatIsWell) {
  PtuStatus status = good();
  status.counters.requests = 7;
  const device::DeviceReport report = ptu_report({}, status, 100.1);
  EXPECT_EQ(report.name, "ptu");
  EXPECT_EQ(report.state, device::DeviceState::kOk);
  EXPECT_EQ(report.text, "PTU-D46 v2.12.1d1(C14/E), 38400 baud");
  EXPECT_THAT(report.alarms, IsEmpty());
  EXPECT_EQ(report.readings.at("ptu_supply_V"), 24.0);
  EXPECT_EQ(report.readings.at("ptu_head_degC"), 30.0);
  EXPECT_EQ(report.readings.count("ptu_pan_degC"), 0u);
  EXPECT_EQ(report.counters.at("ptu_requests"), 7u);
}

TEST(PtuReport, SaysWhatIsWrong) {
  const auto alarms = [](const auto& change) {
    PtuStatus status = good();
    change(status);
    return ptu_report({}, status, 100.1).alarms;
  };
  EXPECT_THAT(alarms([](PtuStatus& s) { s.environment->supply_V = 11.2; }),
              Contains("ptu: supply voltage low (11.2 V)"));
  EXPECT_THAT(alarms([](PtuStatus& s) { s.emergency = true; }),
              Contains("ptu: emergency stop, still moving"));
  EXPECT_THAT(alarms([](PtuStatus& s) { s.emergency = s.standing = true; }),
              Contains("ptu: emergency stop"));
  EXPECT_THAT(alarms([](PtuStatus& s) { s.doubt = PtuDoubtCause::kLimitHit; }),
              Contains(HasSubstr("lost steps")));
  EXPECT_THAT(alarms([](PtuStatus& s) {
                s.state = PtuState::kFault;
                s.doubt = PtuDoubtCause::kPowerCycle;
                s.last_error = describe(*s.doubt);
              }),
              ElementsAre(HasSubstr("lost power")));
  EXPECT_THAT(alarms([](PtuStatus& s) {
                s.lowered_speed = PtuLoweredSpeed{0.174533, 0.116355};
              }),
              Contains(AllOf(HasSubstr("10.0 deg/s^2"), HasSubstr("6.7 deg/s"))));
  EXPECT_THAT(alarms([](PtuStatus& s) {
                s.state = PtuState::kStarting;
                s.homing = true;
              }),
              Contains("ptu: homing"));
  EXPECT_THAT(alarms([](PtuStatus& s) { s.not_referenced = true; }),
              Contains(HasSubstr("home it")));
  EXPECT_THAT(alarms([](PtuStatus& s) { s.last_good_s = 98.0; }), Contains("ptu: no angles"));
  EXPECT_THAT(alarms([](PtuStatus& s) {
                s.state = PtuState::kFault;
                s.last_error = "no reply";
              }),
              Contains("ptu: halted, no reply"));
  EXPECT_THAT(alarms([](PtuStatus& s) {
                s.port.open = false;
                s.last_error = "/dev/x: cannot be opened";
              }),
              Contains(HasSubstr("/dev/x")));
}

}  // namespace
}  // namespace ols::ptu
