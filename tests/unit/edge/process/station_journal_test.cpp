#include "edge/process/station_journal.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "conditions/alarms.h"

namespace ols::station {
namespace {

constexpr clock::ClockPair at(std::int64_t utime_us) {
  clock::ClockPair now{};
  now.monotonic_s = 1e-6 * static_cast<double>(utime_us);
  now.utime_us = utime_us;
  return now;
}

device::DeviceReport failed(const char* name, const char* error, std::uint64_t errors) {
  device::DeviceReport report;
  report.state = device::DeviceState::kFault;
  report.name = name;
  report.last_error = error;
  report.errors = errors;
  return report;
}

class StationJournalTest : public testing::Test {
 protected:
  // The report's last error after this turn.
  std::string noted(std::int64_t utime_us) {
    StationReport report = report_;
    journal_.note(at(utime_us), bus_, report);
    last_utime_us_ = report.last_error_utime_us;
    return report.last_error;
  }
  std::vector<JournalEvent> written_;
  StationJournal journal_{"alfa", [this](const JournalEvent& event) { written_.push_back(event); }};
  StationJournal::Bus bus_{"udpm://", "", "", 0};
  StationReport report_;
  std::int64_t last_utime_us_ = 0;
};

TEST_F(StationJournalTest, NothingWrongIsNoError) { EXPECT_EQ(noted(1'000'000), ""); }

TEST_F(StationJournalTest, TheNewestErrorOfADeviceIsTheStations) {
  report_.devices = {failed("gnss", "", 0), failed("ptu", "no answer", 1)};
  EXPECT_EQ(noted(1'000'000), "ptu: no answer");
  EXPECT_EQ(last_utime_us_, 1'000'000);
  report_.devices[0].last_error = "gpsd has closed the connection";
  report_.devices[0].errors = 1;
  EXPECT_EQ(noted(2'000'000), "gnss: gpsd has closed the connection");
  EXPECT_EQ(last_utime_us_, 2'000'000);
}

TEST_F(StationJournalTest, AnErrorIsOfTheTimeWhenItHappened) {
  report_.devices = {failed("ptu", "no answer", 1)};
  noted(1'000'000);
  noted(2'000'000);
  EXPECT_EQ(last_utime_us_, 1'000'000) << "still the same one";
  report_.devices[0].errors = 2;
  noted(3'000'000);
  EXPECT_EQ(last_utime_us_, 1'000'000) << "a storm of one error is one error";
  report_.devices[0].errors = 3;
  noted(70'000'000);
  EXPECT_EQ(last_utime_us_, 70'000'000) << "the same after a quiet minute";
}

TEST_F(StationJournalTest, ADeviceThatIsComingUpIsNoAlarmYet) {
  report_.devices = {failed("camera", "camera x does not answer: no", 1), failed("gpio", "", 0)};
  for (auto& device : report_.devices) {
    device.state = device::DeviceState::kAbsent;
    device.alarms = alarms_of({device.name + ": does not answer"});
  }
  const auto alarms = [this](std::int64_t utime_us) {
    StationReport report = report_;
    journal_.note(at(utime_us), bus_, report);
    return all_alarms(report);
  };
  ASSERT_EQ(alarms(1'000'000).size(), 1U);
  EXPECT_EQ(alarms(1'000'000).front(), "gpio: does not answer");
  EXPECT_EQ(noted(2'000'000), "gpio: does not answer") << "a stop that is not read is one at once";
  EXPECT_EQ(alarms(10'000'000).size(), 2U) << "by then it should have answered";
}

TEST_F(StationJournalTest, WhatADeviceSaidWhileItCameUpIsNoErrorLaterEither) {
  report_.devices = {failed("camera", "camera x does not answer: no", 1)};
  report_.devices[0].state = device::DeviceState::kAbsent;
  EXPECT_EQ(noted(1'000'000), "");
  report_.devices[0].state = device::DeviceState::kOk;
  report_.devices[0].last_good_s = 2.0;
  EXPECT_EQ(noted(3'000'000), "");
  EXPECT_EQ(noted(30'000'000), "");
}

TEST_F(StationJournalTest, AUnitThatStartsHasItsEmergencyStop) {
  report_.devices = {failed("ptu", "", 0)};
  report_.devices[0].state = device::DeviceState::kStarting;
  report_.devices[0].alarms = {alarm::ptu_emergency_stop()};
  EXPECT_EQ(noted(1'000'000), "ptu: emergency stop");
}

TEST_F(StationJournalTest, ADeviceThatWasThereIsAnAlarmAtOnce) {
  report_.devices = {failed("camera", "camera lost: no frame arrives", 1)};
  report_.devices[0].state = device::DeviceState::kAbsent;
  report_.devices[0].last_good_s = 0.5;
  EXPECT_EQ(noted(1'000'000), "camera lost: no frame arrives");
}

TEST_F(StationJournalTest, WhatHappensHasItsKindAndItsStation) {
  report_.devices = {failed("ptu", "", 0)};
  report_.devices[0].state = device::DeviceState::kAbsent;
  report_.devices[0].text = "no answer";
  report_.alarms = {alarm::gnss_silent("5 s", "position kept")};
  report_.snapshot.state = StationState::kEmergency;
  bus_.last_refusal = "SLEW refused: stale";
  bus_.refusals = 1;
  noted(1'000'000);
  report_.devices[0].state = device::DeviceState::kOk;
  report_.alarms.clear();
  report_.snapshot.state = StationState::kStopped;
  bus_.trouble = "no route";
  noted(2'000'000);
  std::vector<std::pair<event::Id, std::string>> kinds;
  for (const JournalEvent& event : written_) {
    EXPECT_EQ(event.station, "alfa") << event.text;
    kinds.emplace_back(event.id, event.device);
  }
  const std::vector<std::pair<event::Id, std::string>> expected{
      {event::kDeviceLost, "ptu"},        {event::kStationAlarmBegins, "gnss"},
      {event::kCommandRefused, ""},       {event::kBusConnected, "bus"},
      {event::kEmergencyStop, "station"}, {event::kDeviceWorks, "ptu"},
      {event::kStationAlarmEnds, "gnss"}, {event::kDeviceError, "bus"},
      {event::kBusLost, "bus"},           {event::kStationState, "station"}};
  EXPECT_EQ(kinds, expected);
  EXPECT_EQ(written_[0].reason, "no answer");
  EXPECT_EQ(written_[1].reason, "silent for 5 s, position kept");
}

}  // namespace
}  // namespace ols::station
