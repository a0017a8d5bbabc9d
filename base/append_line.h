// A line at the end of a file that outlives a loss of power.
#pragma once

#include <filesystem>
#include <string_view>

namespace ols {

// Adds the line and its end, and returns when the disk has it. Creates the file where there is
// none. std::system_error naming the path; a part of the line may then be there, without its end.
void append_line(const std::filesystem::path& path, std::string_view line);

}  // namespace ols
