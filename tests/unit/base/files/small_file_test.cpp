#include "base/files/small_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

class SmallFile : public testing::Test {
 protected:
  SmallFile() : path_(temp_dir() + "ols_small_file_" + std::to_string(::getpid())) {
    std::filesystem::remove_all(path_);
  }
  ~SmallFile() override { std::filesystem::remove_all(path_); }
  std::error_code failure() const {
    try {
      read_small_file(path_, 8);
    } catch (const std::system_error& error) {
      EXPECT_NE(std::string(error.what()).find(path_), std::string::npos) << error.what();
      return error.code();
    }
    return {};
  }
  const std::string path_;
};

TEST_F(SmallFile, IsReadWhole) {
  std::ofstream(path_) << std::string("12\n\0 678", 8);
  EXPECT_EQ(read_small_file(path_, 8), std::string("12\n\0 678", 8));
}

TEST_F(SmallFile, IsNotReadWhenItIsNotSmall) {
  std::ofstream(path_) << "123456789";
  EXPECT_EQ(failure(), std::errc::file_too_large);
}

TEST_F(SmallFile, MissingIsSaid) { EXPECT_EQ(failure(), std::errc::no_such_file_or_directory); }

TEST_F(SmallFile, ANamedPipeKeepsNobodyWaiting) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(failure(), std::errc::invalid_argument);
}

TEST_F(SmallFile, AFolderIsNone) {
  std::filesystem::create_directory(path_);
  EXPECT_EQ(failure(), std::errc::is_a_directory);
}

}  // namespace
}  // namespace ols
