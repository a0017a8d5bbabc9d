#include "tools/calibrate/command_report.h"

#include <iostream>

namespace ols::calibration {

int tell(const CommandReport& report) {
  for (const std::string& line : report.notes) std::cerr << "ols-calibrate: " << line << '\n';
  for (const std::string& line : report.faults) std::cerr << "ols-calibrate: BAD  " << line << '\n';
  for (const std::string& line : report.summary) std::cout << line << '\n';
  return report.faults.empty() ? 0 : kExitLookAtIt;
}

}  // namespace ols::calibration
