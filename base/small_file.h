// Reads a small file that another program may have replaced, for example by a pipe, without
// blocking.
#pragma once

#include <cstddef>
#include <string>

namespace ols {

// The whole of a plain file. Throws std::system_error that names it when it is not there, cannot be
// read, is not a plain file (reading a pipe would block) or is larger than `most_bytes`.
std::string read_small_file(const std::string& path, std::size_t most_bytes);

}  // namespace ols
