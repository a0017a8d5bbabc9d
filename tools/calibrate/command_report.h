// What a subcommand tells of its result, and the exit status that follows from it.
#pragma once

#include <string>
#include <vector>

namespace ols::calibration {

// Exit status of every subcommand: something that was given is missing in the result, it is not
// within its limits, or it was not accepted. 0: none of these. kExitBadInput: there is no result.
inline constexpr int kExitLookAtIt = 1;

// Sentences.
struct CommandReport {
  std::vector<std::string> summary;  // of the result
  std::vector<std::string> notes;    // what is usual, and nobody need do anything about
  std::vector<std::string> faults;   // what makes the status kExitLookAtIt
};

// The summary to standard output, the others to standard error. Returns the exit status.
int tell(const CommandReport& report);

}  // namespace ols::calibration
