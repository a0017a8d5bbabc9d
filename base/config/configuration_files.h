// The files NAME.toml in /etc/ols. Reserved names belong to the centre's programs and to files
// signed by the site's root; any other name is a station's. Pure.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace ols {

inline constexpr std::array<std::string_view, 7> kProgramFiles{
    "fusion", "logger", "console", "exporter", "export", "cue", "bridge"};
inline constexpr std::array<std::string_view, 2> kSignedFiles{"trust", "site"};

inline bool is_program_file(std::string_view name) {
  return std::ranges::find(kProgramFiles, name) != kProgramFiles.end();
}
inline bool is_station_file(std::string_view name) {
  return !is_program_file(name) && std::ranges::find(kSignedFiles, name) == kSignedFiles.end();
}

}  // namespace ols
