#include "console/event_list.h"

#include <algorithm>
#include <utility>

namespace ols::console {

std::deque<EventList::Kept>::iterator EventList::repeated(const Event& event) {
  if (event.kind == "command") return events_.end();
  return std::ranges::find_if(events_, [&event](const Kept& kept) {
    const bool is_same = kept.event.kind == event.kind && kept.event.station == event.station &&
                         kept.event.text == event.text;
    return is_same && event.utime_us - kept.event.utime_us < kRepeat_us;
  });
}

std::uint64_t EventList::add(Event event, Revision& revision) {
  if (const auto known = repeated(event); known != events_.end()) {
    ++known->times;
    known->changed = ++revision;
    known->event.utime_us = event.utime_us;
    std::rotate(known, known + 1, events_.end());
    return events_.back().number;
  }
  events_.push_back({++numbers_, ++revision, std::move(event), 1});
  if (events_.size() > kMost) events_.pop_front();
  return numbers_;
}

void EventList::conclude(std::uint64_t number, const std::string& outcome, Revision& revision) {
  for (Kept& kept : events_) {
    if (kept.number != number) continue;
    kept.event.outcome = outcome;
    kept.changed = ++revision;
  }
}

Json EventList::since(Revision revision) const {
  Json result = Json::array();
  for (const Kept& kept : events_) {
    if (kept.changed <= revision) continue;
    const Event& e = kept.event;
    result.push_back({{"number", kept.number},
                      {"utime_us", e.utime_us},
                      {"kind", e.kind},
                      {"station", e.station},
                      {"who", e.who},
                      {"text", e.text},
                      {"outcome", e.outcome},
                      {"times", kept.times}});
  }
  return result;
}

}  // namespace ols::console
