// Writes the beginning and the end of a program's alarms into the journal, at a limited rate
// (journal_rate_limit.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/journal/alarm_changes.h"
#include "base/journal/journal.h"
#include "base/journal/journal_rate_limit.h"
#include "conditions/alarm.h"

namespace ols {

class AlarmJournal {
 public:
  using Write = std::function<void(const JournalEvent&)>;

  explicit AlarmJournal(Write write = write_to_journal);

  // Call regularly with the current alarms. `now_s`: monotonic.
  void look(const std::vector<Alarm>& alarms, double now_s);

 private:
  const Write write_;
  AlarmChanges alarms_;
  JournalRateLimit limit_;
};

}  // namespace ols
