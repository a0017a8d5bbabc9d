// The output of a program that must answer in time.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ols {

// Standard output, when the program (searched in PATH) ends with status 0 within the time. It is
// killed when it does not, and is always waited for. Nothing else of this process is handed to it.
std::optional<std::string> command_output(const std::vector<std::string>& command,
                                          double deadline_s);

}  // namespace ols
