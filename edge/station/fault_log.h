// The newest fault of a station, with its time. Both remain after the fault's alarm has ended. Also
// collects journal entries about good and bad changes. Pure.
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
  // `what`: the current error of a source. `number`: number of errors of the source so far; a new
  // number marks a new error even if the text is the same. A text that is repeated within a minute
  // (from an absent device that is retried each second) counts as one fault, so that it does not
  // hide others.
  void note(const std::string& source, const std::string& what, std::uint64_t number,
            std::int64_t utime_us);
  // As note(), for the result of an operator's action. Each one is a new fault.
  void note_event(const std::string& source, const std::string& what, std::uint64_t number,
                  std::int64_t utime_us);
  // Notes an error that does not count, because the device is only starting.
  void pass_over(const std::string& source, const std::string& what, std::uint64_t number,
                 std::int64_t utime_us) {
    noted_[source] = {what, number, utime_us};
  }
  // Takes the present alarms. A new alarm is a fault. A changed number ("silent for 5 s") does not
  // make an alarm new.
  void note_alarms(const std::vector<Alarm>& alarms, std::int64_t utime_us);

  // The state of a source that always has one. A change of state makes an entry; a change of
  // `details` does not.
  struct State {
    std::string name, details;
    bool bad = false;
    event::Id id{};  // the event that begins this state
  };
  void note_state(const std::string& source, const State& state);

  // The entries since the last call (conditions that began or ended), in order.
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
  std::map<std::string, std::string> states_;  // for each source
  std::vector<News> news_;
  std::string text_;
  std::int64_t utime_us_ = 0;
};

}  // namespace ols::station
