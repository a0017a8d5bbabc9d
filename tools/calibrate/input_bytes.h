// How large inputs are, for the progress of reading them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ols::calibration {

// Of all together; 0 where one has no size: a pipe, a receiver's address, a file that is not there.
std::size_t input_bytes(const std::vector<std::string>& paths);

}  // namespace ols::calibration
