// The state of ols-export and its outputs, for people and for programs. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "conditions/alarm.h"
#include "export/outlet/outlet.h"

namespace ols::exports {

struct ExportStatus {
  std::int64_t utime_us = 0;
  std::size_t targets = 0;
  std::vector<Alarm> alarms;  // about the bus
  std::map<std::string, double> counters;
  std::vector<std::pair<std::string, OutletReport>> outputs;  // by name
};

// "12 targets; tak: 345 sent; mqtt: broker:1883: Connection refused".
std::string in_one_line(const ExportStatus& status);
std::string to_json(const ExportStatus& status);

}  // namespace ols::exports
