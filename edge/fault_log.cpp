#include "edge/fault_log.h"

#include <cctype>

namespace ols::station {
namespace {

std::string without_digits(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
  return text;
}

}  // namespace

void FaultLog::set(const std::string& source, const std::string& what, std::int64_t utime_us) {
  news_.push_back({source, source + ": " + what, true});
  text_ = what;
  utime_us_ = utime_us;
}

void FaultLog::note(const std::string& source, const std::string& what, std::uint64_t number,
                    std::int64_t utime_us) {
  constexpr std::int64_t kQuiet_us = 60'000'000;
  if (what.empty()) return;
  Noted& last = noted_[source];
  if (last.what == what && last.number == number) return;
  if (last.what != what || utime_us - last.utime_us > kQuiet_us) set(source, what, utime_us);
  last = {what, number, utime_us};
}

void FaultLog::note_event(const std::string& source, const std::string& what, std::uint64_t number,
                          std::int64_t utime_us) {
  if (what.empty()) return;
  Noted& last = noted_[source];
  if (last.what == what && last.number == number) return;
  set(source, what, utime_us);
  last = {what, number, utime_us};
}

void FaultLog::note_alarms(const std::vector<std::string>& alarms, std::int64_t utime_us) {
  std::map<std::string, std::string> now;
  for (const std::string& alarm : alarms) {
    const std::string key = without_digits(alarm);
    if (!alarms_.contains(key)) {
      news_.push_back({key, "alarm: " + alarm, true});
      text_ = alarm;
      utime_us_ = utime_us;
    }
    now[key] = alarm;
  }
  for (const auto& [key, alarm] : alarms_) {
    if (!now.contains(key)) news_.push_back({key, "over: " + alarm, false});
  }
  alarms_ = std::move(now);
}

void FaultLog::note_state(const std::string& source, const std::string& state,
                          const std::string& details, bool bad) {
  std::string& last = states_[source];
  if (last == state) return;
  last = state;
  const std::string text = source + " " + state;
  news_.push_back({text, details.empty() ? text : text + ": " + details, bad});
}

}  // namespace ols::station
