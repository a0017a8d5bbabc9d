// The fusion's counters and last error.
#pragma once

#include <map>
#include <string>

namespace ols::fusion {

struct FusionLog {
  std::map<std::string, double> counters;  // they only increase
  std::string last_error;

  void count(const std::string& name, double more = 1.0) { counters[name] += more; }
  void error(const std::string& station, const std::string& what) {
    last_error = "station " + station + ": " + what;
  }
  void quarantine(const std::string& station, const std::string& why) {
    count("stations_quarantined");
    error(station, "quarantined, " + why);
  }
};

}  // namespace ols::fusion
