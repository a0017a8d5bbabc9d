// Runs a program with a timeout and returns its output.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols {

// The program's standard output, if it ends with status 0 within deadline_s and writes at most
// `most_bytes`. Otherwise nullopt, and the program is killed. Searches the program in PATH. Returns
// only after the program has ended. The program inherits no other file of this process.
std::optional<std::string> command_output(const std::vector<std::string>& command,
                                          double deadline_s, std::size_t most_bytes = 65536);

}  // namespace ols
