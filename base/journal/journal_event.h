// An event for the journal: its text, its kind, and the parts concerned. Pure.
#pragma once

#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "conditions/event_ids.h"

namespace ols {

struct JournalEvent {
  std::string text{};
  bool bad = false;       // a warning
  event::Id id{};         // empty: of no listed kind
  std::string station{};  // its id
  std::string device{};   // or the part of a program, or a connection
  std::string reason{};   // without the other words of the text
  std::string alarm{};    // its id in conditions.toml
  std::string action{};   // what to do about it
};

// "NAME=value" each, as the journal takes them. Empty fields are left out.
std::vector<std::string> journal_fields(const JournalEvent& event);

// A lost connection to the bus.
JournalEvent bus_lost_event(const std::string& why);
JournalEvent bus_connected_event(const std::string& url);
// An alarm of a program: of a station, if it has one as a parameter, or of a part of the program.
// begins: false if the alarm ends.
JournalEvent alarm_event(const Alarm& alarm, bool begins);
// The same for a station, about its own parts.
JournalEvent station_alarm_event(const Alarm& alarm, bool begins);

}  // namespace ols
