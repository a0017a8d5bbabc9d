// The main of every unit test program: its tests have a folder of their own for temporary files, so
// that programs that run side by side never write each other's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  std::string folder = std::filesystem::temp_directory_path() / "ols-test-XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr || ::setenv("TMPDIR", folder.c_str(), 1) != 0) {
    std::cerr << folder << ": cannot be made\n";
    return EXIT_FAILURE;
  }
  const int result = RUN_ALL_TESTS();
  std::error_code left;
  std::filesystem::remove_all(folder, left);
  return result;
}
