// The fusion's counters and last error.
#pragma once

#include <map>
#include <string>

#include "conditions/alarm.h"

namespace ols::fusion {

struct FusionLog {
  std::map<std::string, double> counters;  // never decrease
  std::string last_error;

  void count(const std::string& name, double more = 1.0) { counters[name] += more; }
  void error(const std::string& station, const std::string& what) {
    last_error = "station " + station + ": " + what;
  }
  void quarantine(const std::string& station, const Alarm& why) {
    count("stations_quarantined");
    error(station, why.reason());
  }
};

}  // namespace ols::fusion
