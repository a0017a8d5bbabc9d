// A small file that may have been put there by anybody: read without waiting for it.
#pragma once

#include <cstddef>
#include <string>

namespace ols {

// The whole of a plain file. Throws std::system_error that names it when it is not there, cannot be
// read, is no plain file (a pipe would keep its reader waiting) or is larger than `most_bytes`.
std::string read_small_file(const std::string& path, std::size_t most_bytes);

}  // namespace ols
