// Finds stations whose tracker follows an object that is none of the present targets. Either no
// other station has seen the object, or the operator has designated the wrong one. Bearings cannot
// distinguish the two cases. The bearing-only track therefore continues, and an alarm asks a person
// to check. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "conditions/alarm.h"

namespace ols::fusion {

struct UnassociatedConfig {
  double alarm_s = 10.0;  // the alarm is raised after this time without an explained bearing
};

class UnassociatedMonitor {
 public:
  explicit UnassociatedMonitor(const UnassociatedConfig& config = {}) : config_(config) {}

  // Takes a bearing that no existing target explains. Times are the station's stamps.
  void unexplained(const std::string& station, std::int64_t utime_us);
  // Takes a bearing that a target explains, or a bearing at a time without targets.
  void explained(const std::string& station) { stations_.erase(station); }
  // The alarm for a station; empty if there is none. now_us: the fusion's time.
  Alarm alarm(const std::string& station, std::int64_t now_us) const;
  void forget(const std::string& station) { stations_.erase(station); }
  void clear() { stations_.clear(); }

 private:
  struct Span {
    std::int64_t from_us = 0, to_us = 0;
  };
  UnassociatedConfig config_;
  std::map<std::string, Span> stations_;
};

}  // namespace ols::fusion
