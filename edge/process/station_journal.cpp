#include "edge/process/station_journal.h"

#include <utility>

namespace ols::station {
namespace {

constexpr double kStart_s = 8.0;  // a device that has not answered by then is an alarm

FaultLog::State state_of(StationState state) {
  const bool emergency = state == StationState::kEmergency;
  return {to_string(state), "", emergency || state == StationState::kLost,
          emergency ? event::kEmergencyStop : event::kStationState};
}

FaultLog::State state_of(const device::DeviceReport& device) {
  using device::DeviceState;
  const bool ails = device.state == DeviceState::kAbsent || device.state == DeviceState::kFault;
  FaultLog::State state{to_string(device.state), ails ? device.text : "", ails};
  if (ails) state.id = event::kDeviceLost;
  if (device.state == DeviceState::kOk) state.id = event::kDeviceWorks;
  return state;
}

// Not GPIO: a stop that cannot be read is an alarm at once. Not a PTU that answers: its emergency
// stop and its reference matter from then on.
bool is_only_starting(const device::DeviceReport& device) {
  if (device.last_good_s || device.name == "gpio") return false;
  const bool starts = device.state == device::DeviceState::kStarting && device.name != "ptu";
  return starts || device.state == device::DeviceState::kAbsent;
}

}  // namespace

StationJournal::StationJournal(std::string station, Write write)
    : station_(std::move(station)), write_(std::move(write)) {}

void StationJournal::hush_what_starts(const clock::ClockPair& now, StationReport& report) {
  if (!begun_s_) begun_s_ = now.monotonic_s;
  if (now.monotonic_s - *begun_s_ > kStart_s) return;
  for (device::DeviceReport& device : report.devices) {
    if (!is_only_starting(device)) continue;
    troubles_.pass_over(device.name, device.last_error, device.errors, now.utime_us);
    device.alarms.clear();
    device.last_error.clear();
  }
}

void StationJournal::note(const clock::ClockPair& now, const Bus& bus, StationReport& report) {
  hush_what_starts(now, report);
  note_devices(report, now.utime_us);
  troubles_.note_alarms(all_alarms(report), now.utime_us);
  note_bus(bus, now.utime_us);
  troubles_.note_state("station", state_of(report.snapshot.state));
  for (JournalEvent& event : limit_.pass(troubles_.take_event(), now.monotonic_s)) {
    event.station = station_;
    write_(event);
  }
  report.last_error = troubles_.text();
  report.last_error_utime_us = troubles_.utime_us();
}

void StationJournal::note_devices(const StationReport& report, std::int64_t utime_us) {
  for (const device::DeviceReport& device : report.devices) {
    troubles_.note(device.name, device.last_error, device.errors, utime_us);
    troubles_.note_state(device.name, state_of(device));
  }
}

void StationJournal::note_bus(const Bus& bus, std::int64_t utime_us) {
  troubles_.note_event("command", bus.last_refusal, bus.refusals, utime_us);
  troubles_.note("bus", bus.trouble, 0, utime_us);
  if (bus.trouble.empty()) {
    troubles_.note_state("bus", {"connected", bus.url, false, event::kBusConnected});
  } else {
    troubles_.note_state("bus", {"none", "retrying every second", true, event::kBusLost});
  }
}

}  // namespace ols::station
