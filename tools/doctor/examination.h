// Runs all probes in order and judges the results.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/doctor/finding.h"

namespace ols::doctor {

struct Request {
  std::vector<std::string> stations;  // configuration files
  // Configuration files of the centre's programs, by the program's name.
  std::map<std::string, std::string> programs;
  double listen_s = 2.2;    // two status intervals of the slowest sender
  double patience_s = 4.0;  // how long to wait until a sensor is ready
};

// Finds the configuration files of this host: `folder`/*.toml.
Request find_configurations(const std::string& folder);

struct Examination {
  Findings findings;
  std::map<std::string, std::string> statuses;  // the last status of each station
};
Examination examine(const Request& request);

}  // namespace ols::doctor
