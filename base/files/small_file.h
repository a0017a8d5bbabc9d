// Reads a small file. Never blocks, even if another program has replaced the file with a pipe.
#pragma once

#include <cstddef>
#include <string>

namespace ols {

// The content of a plain file. Throws std::system_error naming the file if the file does not exist,
// cannot be read, is not a plain file (reading a pipe would block) or is larger than `most_bytes`.
std::string read_small_file(const std::string& path, std::size_t most_bytes);

}  // namespace ols
