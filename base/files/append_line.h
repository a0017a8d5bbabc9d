// Appends a line to a file so that it survives a loss of power.
#pragma once

#include <filesystem>
#include <string_view>

namespace ols {

// Appends the line with a line end, and returns when it is on disk. Creates the file if needed.
// Throws std::system_error naming the path; a part of the line may then be in the file, without its
// end.
void append_line(const std::filesystem::path& path, std::string_view line);

}  // namespace ols
