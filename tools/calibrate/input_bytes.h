// The size of inputs, for the progress of reading them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ols::calibration {

// Total size; 0 if the size of any is unknown: a pipe, a receiver's address, a missing file.
std::size_t input_bytes(const std::vector<std::string>& paths);

}  // namespace ols::calibration
