#include "base/journal/journal_event.h"

namespace ols {
namespace {

// Syslog's.
constexpr const char* kWarning = "4";
constexpr const char* kInformation = "6";

JournalEvent about(const Alarm& alarm, bool begins) {
  JournalEvent event{.text = (begins ? "alarm: " : "over: ") + alarm.text, .bad = begins};
  event.alarm = alarm.id;
  event.action = alarm.row().action;
  event.device = alarm.part();
  event.reason = alarm.reason();
  return event;
}

}  // namespace

std::vector<std::string> journal_fields(const JournalEvent& event) {
  std::vector<std::string> fields{"MESSAGE=" + event.text,
                                  std::string("PRIORITY=") + (event.bad ? kWarning : kInformation)};
  const auto add = [&fields](const char* name, const std::string& value) {
    if (!value.empty()) fields.push_back(name + value);
  };
  add("MESSAGE_ID=", std::string(event.id));
  add("OLS_STATION=", event.station);
  add("OLS_DEVICE=", event.device);
  add("OLS_REASON=", event.reason);
  add("OLS_ALARM=", event.alarm);
  add("OLS_ACTION=", event.action);
  return fields;
}

JournalEvent bus_lost_event(const std::string& why) {
  return {.text = "no bus, retrying every second: " + why,
          .bad = true,
          .id = event::kBusLost,
          .device = "bus",
          .reason = why};
}

JournalEvent bus_connected_event(const std::string& url) {
  return {.text = "connected to " + url, .id = event::kBusConnected, .device = "bus"};
}

JournalEvent alarm_event(const Alarm& alarm, bool begins) {
  JournalEvent event = about(alarm, begins);
  event.id = begins ? event::kAlarmBegins : event::kAlarmEnds;
  event.station = alarm.parameter("station");
  if (!event.station.empty()) event.device.clear();
  return event;
}

JournalEvent station_alarm_event(const Alarm& alarm, bool begins) {
  JournalEvent event = about(alarm, begins);
  event.id = begins ? event::kStationAlarmBegins : event::kStationAlarmEnds;
  return event;
}

}  // namespace ols
