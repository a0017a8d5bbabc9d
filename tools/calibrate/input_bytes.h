// The size of input files, for showing the progress of reading.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ols::calibration {

// The total size. It is 0 if the size of any input is unknown: of a pipe, a receiver's address, or
// a missing file.
std::size_t input_bytes(const std::vector<std::string>& paths);

}  // namespace ols::calibration
