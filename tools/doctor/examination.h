// One examination: asks in a sensible order, and judges.
#pragma once

#include <string>
#include <vector>

#include "tools/doctor/finding.h"

namespace ols::doctor {

struct Request {
  std::vector<std::string> stations;  // configuration files
  std::string fusion;                 // configuration file; empty: this host has none
  std::string logger;                 // the same
  double listen_s = 2.2;              // two intervals of the slowest sender
  double patience_s = 4.0;            // for a sensor to be well
};

// What is configured on this host: `folder`/*.toml.
Request find_configurations(const std::string& folder);

Findings examine(const Request& request);

}  // namespace ols::doctor
