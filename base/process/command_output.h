// Runs a program with a timeout and returns its output.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols {

// Returns the program's standard output if the program ends with status 0 within deadline_s and
// writes at most `most_bytes`. Otherwise kills the program and returns nullopt. Searches PATH for
// the program. Returns only after the program has ended. The program inherits no open file of this
// process.
std::optional<std::string> command_output(const std::vector<std::string>& command,
                                          double deadline_s, std::size_t most_bytes = 65536);

}  // namespace ols
