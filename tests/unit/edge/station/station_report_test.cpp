#include "edge/station/station_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::station {
namespace {

using device::DeviceState;
using testing::ElementsAre;
using testing::IsEmpty;

device::DeviceReport device_in(const char* name, DeviceState state,
                               const std::vector<std::string>& alarms = {}) {
  device::DeviceReport report;
  report.name = name;
  report.state = state;
  report.alarms = alarms_of(alarms);
  return report;
}

TEST(StationReport, OneAlarmIsToldOnceWhoeverRaisedIt) {
  StationReport report;
  EXPECT_THAT(all_alarms(report), IsEmpty());
  report.alarms = alarms_of({"clock: not synchronised", "bus: silent"});
  report.devices = {device_in("gnss", DeviceState::kOk, {"gnss: no fix", "bus: silent"}),
                    device_in("ptu", DeviceState::kOk, {"gnss: no fix"})};
  EXPECT_THAT(all_alarms(report),
              ElementsAre("clock: not synchronised", "bus: silent", "gnss: no fix"));
}

TEST(StationReport, TheLineNamesOnlyWhatIsNotWell) {
  StationReport report;
  report.snapshot.state = StationState::kTracking;
  report.devices = {device_in("camera", DeviceState::kOk)};
  EXPECT_EQ(in_one_line(report), "tracking");
  report.devices.push_back(device_in("ptu", DeviceState::kStarting));
  report.devices.push_back(device_in("gnss", DeviceState::kAbsent));
  EXPECT_EQ(in_one_line(report), "tracking; ptu starting; gnss absent");
}

TEST(StationReport, TheLineHasTheFirstAlarmAndCountsTheOthers) {
  StationReport report;
  report.alarms = alarms_of({"a"});
  EXPECT_EQ(in_one_line(report), "idle; a");
  report.alarms = alarms_of({"a", "b", "c", "b"});
  EXPECT_EQ(in_one_line(report), "idle; a and 2 more alarms");
}

}  // namespace
}  // namespace ols::station
