// The folder for temporary files of this test program, ending in '/'. (testing::TempDir() of
// GoogleTest 1.12 is always /tmp/.)
#pragma once

#include <filesystem>
#include <string>

namespace ols {

inline std::string temp_dir() { return std::filesystem::temp_directory_path().string() + "/"; }

}  // namespace ols
