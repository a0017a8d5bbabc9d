// What a subcommand reports about its result, and the exit status that follows from it.
#pragma once

#include <string>
#include <vector>

namespace ols::calibration {

// Exit status of every subcommand if some input is missing in the result, or the result is not
// within its limits or was not accepted. 0: none of these. kExitBadInput: there is no result.
inline constexpr int kExitLookAtIt = 1;

// Sentences.
struct CommandReport {
  std::vector<std::string> summary;  // about the result
  std::vector<std::string> notes;    // usual remarks; nobody need do anything about them
  std::vector<std::string> faults;   // each of them makes the status kExitLookAtIt
};

// Writes the summary to standard output, the rest to standard error. Returns the exit status.
int tell(const CommandReport& report);

}  // namespace ols::calibration
