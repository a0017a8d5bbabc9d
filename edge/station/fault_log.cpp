#include "edge/station/fault_log.h"

namespace ols::station {

void FaultLog::set(const std::string& source, JournalEvent event, std::int64_t utime_us) {
  const bool says_source = event.reason.starts_with(source);
  event.text = says_source ? event.reason : source + ": " + event.reason;
  text_ = event.id == event::kCommandRefused ? event.reason : event.text;
  utime_us_ = utime_us;
  event.bad = true;
  news_.push_back({source, std::move(event)});
}

void FaultLog::note(const std::string& source, const std::string& what, std::uint64_t number,
                    std::int64_t utime_us) {
  constexpr std::int64_t kQuiet_us = 60'000'000;
  if (what.empty()) return;
  Noted& last = noted_[source];
  if (last.what == what && last.number == number) return;
  if (last.what != what || utime_us - last.utime_us > kQuiet_us) {
    set(source, {.id = event::kDeviceError, .device = source, .reason = what}, utime_us);
  }
  last = {what, number, utime_us};
}

void FaultLog::note_event(const std::string& source, const std::string& what, std::uint64_t number,
                          std::int64_t utime_us) {
  if (what.empty()) return;
  Noted& last = noted_[source];
  if (last.what == what && last.number == number) return;
  set(source, {.id = event::kCommandRefused, .reason = what}, utime_us);
  last = {what, number, utime_us};
}

void FaultLog::note_alarms(const std::vector<Alarm>& alarms, std::int64_t utime_us) {
  for (const AlarmChanges::Change& change : alarms_.look(alarms)) {
    news_.push_back({change.key, station_alarm_event(change.alarm, change.begins)});
    if (!change.begins) continue;
    text_ = change.alarm.text;
    utime_us_ = utime_us;
  }
}

void FaultLog::note_state(const std::string& source, const State& state) {
  std::string& last = states_[source];
  if (last == state.name) return;
  last = state.name;
  const std::string text = source + " " + state.name;
  JournalEvent event{.text = state.details.empty() ? text : text + ": " + state.details,
                     .bad = state.bad,
                     .id = state.id,
                     .device = source,
                     .reason = state.details.empty() ? state.name : state.details};
  news_.push_back({text, std::move(event)});
}

}  // namespace ols::station
