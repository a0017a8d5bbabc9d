// Keeps the newest fault of a station, with its time. Both remain after the fault's alarm has
// ended. It also collects journal entries about conditions that begin or end. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/journal/alarm_changes.h"
#include "base/journal/journal_rate_limit.h"
#include "conditions/alarm.h"

namespace ols::station {

class FaultLog {
 public:
  // `what`: the current error of a source. `number`: how many errors the source has had so far; a
  // new number marks a new error even if its text is the same. An error with the same text within a
  // minute is not a new fault. Otherwise an absent device, which is retried each second, would hide
  // other faults.
  void note(const std::string& source, const std::string& what, std::uint64_t number,
            std::int64_t utime_us);
  // Like note(), for the failure of an operator's action. Each failure is a new fault.
  void note_event(const std::string& source, const std::string& what, std::uint64_t number,
                  std::int64_t utime_us);
  // Ignores an error, because the device is only starting: note() will then not report it.
  void pass_over(const std::string& source, const std::string& what, std::uint64_t number,
                 std::int64_t utime_us) {
    noted_[source] = {what, number, utime_us};
  }
  // Takes the present alarms. A new alarm is a fault. An alarm whose number changes ("silent for 5
  // s") is not a new one.
  void note_alarms(const std::vector<Alarm>& alarms, std::int64_t utime_us);

  // The state of a source. A change of `name` makes a journal entry; a change of `details` alone
  // does not.
  struct State {
    std::string name, details;
    bool bad = false;
    event::Id id{};  // the event that begins this state
  };
  void note_state(const std::string& source, const State& state);

  // The entries since the last call, in order: conditions that began or ended.
  std::vector<News> take_event() { return std::exchange(news_, {}); }

  const std::string& text() const { return text_; }  // empty if there was no fault
  std::int64_t utime_us() const { return utime_us_; }

 private:
  struct Noted {
    std::string what;
    std::uint64_t number = 0;
    std::int64_t utime_us = 0;  // time of its last report
  };
  void set(const std::string& source, JournalEvent event, std::int64_t utime_us);

  std::map<std::string, Noted> noted_;
  AlarmChanges alarms_;
  std::map<std::string, std::string> states_;  // the last state of each source, by name
  std::vector<News> news_;
  std::string text_;
  std::int64_t utime_us_ = 0;
};

}  // namespace ols::station
