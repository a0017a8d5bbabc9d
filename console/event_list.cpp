#include "console/event_list.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "conditions/alarm_json.h"

namespace ols::console {
namespace {

constexpr std::int64_t kAnswer_us = 5'000'000;  // a refused command is answered within

std::string without_numbers(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
  return text;
}

// Alarms are identified by their keys; other events by their texts without the numbers.
std::string key_of(const Event& event) {
  const bool is_alarm = event.kind == "alarm" && !event.said.empty();
  return is_alarm ? event.said.key() : without_numbers(event.text);
}

// Whether an error repeats an alarm, or comes from the part that the alarm is about.
bool is_about(const Event& error, const Event& alarm) {
  const std::string part = alarm.said.part();
  return without_numbers(error.text) == without_numbers(alarm.text) ||
         (!part.empty() && error.text.starts_with(part));
}

bool is_refusal(const std::string& error) { return error.find(" refused: ") != std::string::npos; }

}  // namespace

std::deque<EventList::Kept>::iterator EventList::repeated(const Event& event,
                                                          const std::string& key) {
  if (event.kind == "command") return events_.end();
  return std::ranges::find_if(events_, [&](const Kept& kept) {
    const bool is_same =
        kept.event.kind == event.kind && kept.event.station == event.station && kept.key == key;
    const std::int64_t last_us = kept.over_us.value_or(kept.event.utime_us);
    return is_same && (kept.holds() || event.utime_us - last_us < kRepeat_us);
  });
}

// Whether the error says nothing new. A station's last error may repeat a new alarm, what a device
// said of it, or the reason why a command was refused.
bool EventList::explains_another(const Event& error) const {
  if (error.kind != "error") return false;
  return std::ranges::any_of(events_, [&](const Kept& kept) {
    if (kept.event.station != error.station) return false;
    if (kept.holds()) return is_about(error, kept.event);
    if (kept.over_us) {
      return without_numbers(error.text) == without_numbers(kept.event.text) &&
             error.utime_us - *kept.over_us < kRepeat_us;
    }
    return kept.event.kind == "command" && is_refusal(error.text) &&
           error.utime_us - kept.event.utime_us < kAnswer_us;
  });
}

// A device reports an error, and an alarm follows when it lasts.
std::deque<EventList::Kept>::iterator EventList::first_sign(const Event& event) {
  if (event.kind != "alarm") return events_.end();
  return std::ranges::find_if(events_, [&](const Kept& kept) {
    return kept.event.kind == "error" && kept.event.station == event.station &&
           event.utime_us - kept.event.utime_us < kAnswer_us && is_about(kept.event, event);
  });
}

// Alarms that hold are kept as long as there is anything else.
void EventList::forget_oldest() {
  const auto oldest = std::ranges::find_if_not(events_, &Kept::holds);
  events_.erase(oldest == events_.end() ? events_.begin() : oldest);
}

std::uint64_t EventList::add(Event event, Revision& revision) {
  const std::string key = key_of(event);
  if (explains_another(event)) return 0;
  if (const auto known = repeated(event, key); known != events_.end()) {
    ++known->times;
    known->changed = ++revision;
    known->event.utime_us = event.utime_us;
    known->event.text = std::move(event.text);
    known->event.said = std::move(event.said);
    known->over_us.reset();
    std::rotate(known, known + 1, events_.end());
    return events_.back().number;
  }
  if (const auto sign = first_sign(event); sign != events_.end()) {
    *sign = {sign->number, ++revision, std::move(event), key, 1, {}, {}};
    std::rotate(sign, sign + 1, events_.end());
    return events_.back().number;
  }
  events_.push_back({++numbers_, ++revision, std::move(event), key, 1, {}, {}});
  if (events_.size() > kMost) forget_oldest();
  return numbers_;
}

void EventList::conclude(std::uint64_t number, const Outcome& refusal, Revision& revision) {
  for (Kept& kept : events_) {
    if (kept.number != number) continue;
    kept.event.outcome = refusal.empty() ? "done" : refusal.text;
    kept.event.refusal = refusal;
    kept.changed = ++revision;
  }
}

void EventList::end(const std::string& station, const std::string& key, std::int64_t utime_us,
                    Revision& revision) {
  for (Kept& kept : events_) {
    if (!kept.holds() || kept.event.station != station || kept.key != key) continue;
    kept.over_us = utime_us;
    kept.changed = ++revision;
  }
}

void EventList::end_all(const std::string& station, std::int64_t utime_us, Revision& revision) {
  for (Kept& kept : events_) {
    if (!kept.holds() || kept.event.station != station) continue;
    kept.over_us = utime_us;
    kept.changed = ++revision;
  }
}

bool EventList::acknowledge(std::uint64_t number, const std::string& who, Revision& revision) {
  const auto known = std::ranges::find_if(events_, [number](const Kept& kept) {
    return kept.number == number && kept.event.kind == "alarm";
  });
  if (known == events_.end()) return false;
  known->acknowledged = who;
  known->changed = ++revision;
  return true;
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
                      {"key", kept.key},
                      {"said", e.said.empty() ? Json(nullptr) : Json(e.said)},
                      {"outcome", e.outcome},
                      {"refusal", e.refusal.empty() ? Json(nullptr) : Json(e.refusal)},
                      {"over_us", kept.over_us ? Json(*kept.over_us) : Json(nullptr)},
                      {"acknowledged", kept.acknowledged},
                      {"times", kept.times}});
  }
  return result;
}

}  // namespace ols::console
