// The list of events at the site: errors, alarms and commands, each with its time, person and
// outcome. Keeps only the newest. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "conditions/refusal.h"
#include "console/entity_table.h"

namespace ols::console {

struct Event {
  std::int64_t utime_us = 0;  // this host's UTC
  std::string kind;           // "error", "alarm", "command", "site", "console"
  std::string station;        // empty: the event concerns the site
  std::string who;            // the person who gave a command
  std::string text;
  std::string outcome;  // outcome of a command: empty while unknown, "sent", "done", or the text of
                        // the refusal
  Alarm said{};         // the alarm or note, with id and parameters; empty if there is only a text
  Outcome refusal{};    // why a command was not carried out
};

// Makes an event from a note (a row of conditions.toml).
inline Event noted(std::int64_t utime_us, const char* kind, const std::string& station,
                   const std::string& who, const Alarm& note, const std::string& outcome = {}) {
  return {utime_us, kind, station, who, note.text, outcome, note};
}

class EventList {
 public:
  // Adds an event. Returns the event's number, by which its outcome can be added later. If an event
  // is repeated within kRepeat_us, the known event is counted again and moves to the end, so that
  // repetitions push out no other event; this is not done for commands. An alarm stays active until
  // end(). An error that only explains an active alarm or a refused command is not listed; the
  // result is then 0. If the error comes before its alarm, the alarm replaces it.
  std::uint64_t add(Event event, Revision& revision);
  void conclude(std::uint64_t number, const Outcome& refusal, Revision& revision);

  // The alarm with this key has ended.
  void end(const std::string& station, const std::string& key, std::int64_t utime_us,
           Revision& revision);
  // All alarms of a station have ended.
  void end_all(const std::string& station, std::int64_t utime_us, Revision& revision);
  // Notes that somebody handles this alarm. False: there is no such alarm.
  bool acknowledge(std::uint64_t number, const std::string& who, Revision& revision);

  Json since(Revision revision) const;  // events added or changed since, as an array, oldest first
  static constexpr std::size_t kMost = 500;
  static constexpr std::int64_t kRepeat_us = 60'000'000;

 private:
  struct Kept {
    std::uint64_t number;
    Revision changed;
    Event event;
    std::string key;  // the same for repetitions of an event
    int times = 1;
    std::optional<std::int64_t> over_us;  // when an alarm ended; nullopt: it is active
    std::string acknowledged;             // the person who handles the alarm
    bool holds() const { return event.kind == "alarm" && !over_us; }
  };
  std::deque<Kept>::iterator repeated(const Event& event, const std::string& key);
  std::deque<Kept>::iterator first_sign(const Event& event);
  bool explains_another(const Event& error) const;
  void forget_oldest();

  std::deque<Kept> events_;
  std::uint64_t numbers_ = 0;
};

}  // namespace ols::console
