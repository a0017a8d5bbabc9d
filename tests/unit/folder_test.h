// A test with its own folder, which is empty at the beginning of the test and removed at its end.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/unit/temp_dir.h"

namespace ols {

template <class Path = std::string>
class FolderTest : public testing::Test {
 protected:
  FolderTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FolderTest() override { std::filesystem::remove_all(folder_); }

  const Path folder_ = temp_dir() + testing::UnitTest::GetInstance()->current_test_info()->name();
};

}  // namespace ols
