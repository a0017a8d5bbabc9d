// The events at the site: errors, alarms, commands, each with who, when and the outcome. The newest
// are kept. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "console/entity_table.h"

namespace ols::console {

struct Event {
  std::int64_t utime_us = 0;  // this host's UTC
  std::string kind;           // "error", "alarm", "alarm_over", "command", "site", "console"
  std::string station;        // empty: the site
  std::string who;            // of a command
  std::string text;
  std::string outcome;  // of a command: empty until it is known, "done", or the reason
};

class EventList {
 public:
  // Its number, by which its outcome can be added. What repeats itself within kRepeat_us, but for
  // commands, is counted and moves to the end, not listed again: it must not push out what else
  // happened.
  std::uint64_t add(Event event, Revision& revision);
  void conclude(std::uint64_t number, const std::string& outcome, Revision& revision);

  Json since(Revision revision) const;  // an array, oldest first
  static constexpr std::size_t kMost = 500;
  static constexpr std::int64_t kRepeat_us = 60'000'000;

 private:
  struct Kept {
    std::uint64_t number;
    Revision changed;
    Event event;
    int times = 1;
  };
  std::deque<Kept>::iterator repeated(const Event& event);
  std::deque<Kept> events_;
  std::uint64_t numbers_ = 0;
};

}  // namespace ols::console
