// The state of ols-cue and its inputs, for people and for programs. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "cue/live_cues.h"

namespace ols::cues {

struct InputStatus {
  std::string name;
  bool is_open = false;
  std::string trouble;
  std::int64_t openings = 0, failures = 0, bytes = 0;
  InputCounts counts;
};

struct CueStatus {
  std::int64_t utime_us = 0;
  std::size_t cues = 0;
  std::vector<Alarm> alarms;  // about the bus
  std::map<std::string, double> counters;
  std::vector<InputStatus> inputs;
};

// "3 cues; tak: 12 taken, 2 refused (last x: stale); adsb: 10.0.0.9:30003: no answer".
std::string in_one_line(const CueStatus& status);
std::string to_json(const CueStatus& status);

}  // namespace ols::cues
