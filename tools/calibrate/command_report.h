// A subcommand's report about its result, and the exit status that follows.
#pragma once

#include <string>
#include <vector>

namespace ols::calibration {

// The exit status of a subcommand whose result lacks some of the input, is outside of its limits or
// was not accepted. Otherwise the status is 0, or kExitBadInput if there is no result.
inline constexpr int kExitLookAtIt = 1;

// Sentences.
struct CommandReport {
  std::vector<std::string> summary;  // about the result
  std::vector<std::string> notes;    // remarks that need no action
  std::vector<std::string> faults;   // any fault makes the status kExitLookAtIt
};

// Writes the summary to standard output, notes and faults to standard error. Returns the exit
// status.
int tell(const CommandReport& report);

}  // namespace ols::calibration
