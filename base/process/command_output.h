// Runs a program with a timeout and returns its output.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols {

// The program's standard output, if it ends with status 0 within the timeout and writes at most
// `most_bytes`. Otherwise nullopt, and the program is killed. The program is searched in PATH, its
// end is always awaited, and it inherits no other file of this process.
std::optional<std::string> command_output(const std::vector<std::string>& command,
                                          double deadline_s, std::size_t most_bytes = 65536);

}  // namespace ols
