// One examination: runs the probes in order, and judges the results.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/doctor/finding.h"

namespace ols::doctor {

struct Request {
  std::vector<std::string> stations;            // configuration files
  std::map<std::string, std::string> programs;  // configuration files of the centre's programs, by
                                                // name
  double listen_s = 2.2;                        // two intervals of the slowest sender
  double patience_s = 4.0;                      // for a sensor to become ready
};

// The configuration files of this host: `folder`/*.toml.
Request find_configurations(const std::string& folder);

struct Examination {
  Findings findings;
  std::map<std::string, std::string> statuses;  // last heard, by station
};
Examination examine(const Request& request);

}  // namespace ols::doctor
