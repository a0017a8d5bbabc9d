#include "base/journal/alarm_journal.h"

#include <utility>

namespace ols {

AlarmJournal::AlarmJournal(Write write) : write_(std::move(write)) {}

void AlarmJournal::look(const std::vector<Alarm>& alarms, double now_s) {
  std::vector<News> news;
  for (const AlarmChanges::Change& change : alarms_.look(alarms)) {
    news.push_back({change.key, alarm_event(change.alarm, change.begins)});
  }
  for (const JournalEvent& event : limit_.pass(news, now_s)) write_(event);
}

}  // namespace ols
