// Runs a program with a timeout and returns its output.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols {

// Standard output of the program (searched in PATH), if it ends with status 0 within the timeout
// and says no more than `most_bytes`; else the program is killed. It is always waited for, and
// inherits no other file of this process.
std::optional<std::string> command_output(const std::vector<std::string>& command,
                                          double deadline_s, std::size_t most_bytes = 65536);

}  // namespace ols
