// Appends a line to a file so that the line survives a loss of power.
#pragma once

#include <filesystem>
#include <string_view>

namespace ols {

// Appends the line and a line end, and returns when both are on disk. Creates the file if needed.
// Throws std::system_error naming the path; the file may then hold the beginning of the line.
void append_line(const std::filesystem::path& path, std::string_view line);

}  // namespace ols
