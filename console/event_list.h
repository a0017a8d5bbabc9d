// The events at the site (errors, alarms, commands), each with its time, person and outcome. Only
// the newest are kept. Pure.
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
  std::string station;        // empty: it concerns the site
  std::string who;            // the person who gave a command
  std::string text;
  std::string outcome;  // of a command: empty while unknown, "sent", "done", or the text of the
                        // refusal
  Alarm said{};         // the alarm or note with id and parameters; for an error only its text
  Outcome refusal{};    // why a command is not carried out
};

// Makes the event of a note of the table.
inline Event noted(std::int64_t utime_us, const char* kind, const std::string& station,
                   const std::string& who, const Alarm& note, const std::string& outcome = {}) {
  return {utime_us, kind, station, who, note.text, outcome, note};
}

class EventList {
 public:
  // Returns the event's number, by which its outcome can be added later. An event, except a
  // command, that is repeated within kRepeat_us is counted and moves to the end, so that it pushes
  // out no other event. An alarm holds until it is ended. An error that only explains an alarm or a
  // refused command is not listed (0). If the error comes first, the alarm takes over its row.
  std::uint64_t add(Event event, Revision& revision);
  void conclude(std::uint64_t number, const Outcome& refusal, Revision& revision);

  // The alarm with this key has ended.
  void end(const std::string& station, const std::string& key, std::int64_t utime_us,
           Revision& revision);
  // All alarms of a station have ended.
  void end_all(const std::string& station, std::int64_t utime_us, Revision& revision);
  // Somebody has seen this alarm and handles it. False: there is no such alarm.
  bool acknowledge(std::uint64_t number, const std::string& who, Revision& revision);

  Json since(Revision revision) const;  // as an array, oldest first
  static constexpr std::size_t kMost = 500;
  static constexpr std::int64_t kRepeat_us = 60'000'000;

 private:
  struct Kept {
    std::uint64_t number;
    Revision changed;
    Event event;
    std::string key;  // equal for repetitions of the same event
    int times = 1;
    std::optional<std::int64_t> over_us;  // when an alarm ended; nullopt: it holds
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
