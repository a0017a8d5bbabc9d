// What happened, for a person and for who searches the journal: a text, its kind, and what it is
// about. Pure.
#pragma once

#include <string>
#include <vector>

#include "base/event_ids.h"

namespace ols {

struct JournalEvent {
  std::string text{};
  bool bad = false;       // a warning
  event::Id id{};         // empty: of no listed kind
  std::string station{};  // its id
  std::string device{};   // or the part of a program, or a connection, that it is about
  std::string reason{};   // without the words that the text has besides
};

// "NAME=value" each, as the journal takes them; what is empty is left out.
std::vector<std::string> journal_fields(const JournalEvent& event);

// A program's connection to the bus.
JournalEvent bus_lost_event(const std::string& why);
JournalEvent bus_connected_event(const std::string& url);
// An alarm of a program: the words before its first colon are what it is about, "station NAME" or a
// part; the others are its reason. `begins`: or it is over.
JournalEvent alarm_event(const std::string& alarm, bool begins);
// The same of a station, about its own parts.
JournalEvent station_alarm_event(const std::string& alarm, bool begins);

}  // namespace ols
