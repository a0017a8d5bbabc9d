#include "console/event_list.h"

#include <utility>

namespace ols::console {

EventList::Kept* EventList::repeated(const Event& event) {
  if (event.kind == "command") return nullptr;
  for (Kept& kept : events_) {
    const bool is_same = kept.event.kind == event.kind && kept.event.station == event.station &&
                         kept.event.text == event.text;
    if (is_same && event.utime_us - kept.event.utime_us < kRepeat_us) return &kept;
  }
  return nullptr;
}

std::uint64_t EventList::add(Event event, Revision& revision) {
  if (Kept* known = repeated(event)) {
    ++known->times;
    known->changed = ++revision;
    return known->number;
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
