#include "tools/calibrate/input_bytes.h"

#include <filesystem>
#include <system_error>

namespace ols::calibration {

std::size_t input_bytes(const std::vector<std::string>& paths) {
  std::size_t all = 0;
  for (const std::string& path : paths) {
    std::error_code has_none;
    const std::uintmax_t bytes = std::filesystem::file_size(path, has_none);
    if (has_none) return 0;
    all += bytes;
  }
  return all;
}

}  // namespace ols::calibration
