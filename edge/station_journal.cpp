#include "edge/station_journal.h"

#include <spdlog/spdlog.h>

namespace ols::station {

void StationJournal::note(const clock::ClockPair& now, const Bus& bus, StationReport& report) {
  note_devices(report, now.utime_us);
  troubles_.note_alarms(all_alarms(report), now.utime_us);
  note_bus(bus, now.utime_us);
  const StationState state = report.snapshot.state;
  const bool bad = state == StationState::kLost || state == StationState::kEmergency;
  troubles_.note_state("station", to_string(state), "", bad);
  for (const JournalLine& line : journal_.pass(troubles_.take_event(), now.monotonic_s)) {
    spdlog::log(line.bad ? spdlog::level::warn : spdlog::level::info, "{}", line.text);
  }
  report.last_error = troubles_.text();
  report.last_error_utime_us = troubles_.utime_us();
}

void StationJournal::note_devices(const StationReport& report, std::int64_t utime_us) {
  for (const device::DeviceReport& device : report.devices) {
    troubles_.note(device.name, device.last_error, device.errors, utime_us);
    const bool ails =
        device.state == device::DeviceState::kAbsent || device.state == device::DeviceState::kFault;
    troubles_.note_state(device.name, to_string(device.state), ails ? device.text : "", ails);
  }
}

void StationJournal::note_bus(const Bus& bus, std::int64_t utime_us) {
  troubles_.note_event("command", bus.last_refusal, bus.refusals, utime_us);
  troubles_.note("bus", bus.trouble, 0, utime_us);
  if (bus.trouble.empty()) {
    troubles_.note_state("bus", "connected", bus.url, false);
  } else {
    troubles_.note_state("bus", "none", "retrying every second", true);
  }
}

}  // namespace ols::station
