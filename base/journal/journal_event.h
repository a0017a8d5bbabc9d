// An event for the journal: its text, its kind, and the station and device that it is about. Pure.
#pragma once

#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "conditions/event_ids.h"

namespace ols {

struct JournalEvent {
  std::string text{};
  bool bad = false;       // a warning
  event::Id id{};         // the kind of event; empty: none of the listed kinds
  std::string station{};  // the id of the station that the event is about
  std::string device{};   // the device, the part of a program or the connection that it is about
  std::string reason{};   // why it happened; a part of the text
  std::string alarm{};    // the alarm's id in conditions.toml; empty: not an alarm
  std::string action{};   // what a person should do about it
};

// Returns "NAME=value" texts, as the journal takes them. Empty fields are left out.
std::vector<std::string> journal_fields(const JournalEvent& event);

// Events for a lost connection to the bus, and for a new connection.
JournalEvent bus_lost_event(const std::string& why);
JournalEvent bus_connected_event(const std::string& url);
// An event for a program's alarm. It is about the station that the alarm's parameters name; if they
// name none, about a part of the program. begins: false if the alarm ends.
JournalEvent alarm_event(const Alarm& alarm, bool begins);
// An event for a station's alarm, about one of the station's parts.
JournalEvent station_alarm_event(const Alarm& alarm, bool begins);

}  // namespace ols
