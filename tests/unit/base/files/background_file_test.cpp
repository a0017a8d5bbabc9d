#include "base/files/background_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/unit/eventually.h"
#include "tests/unit/folder_test.h"

namespace ols {
namespace {

namespace fs = std::filesystem;

constexpr double kLong_s = 60.0;

class BackgroundFileTest : public FolderTest<std::filesystem::path> {
 protected:
  std::string content() const {
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }
  const fs::path path_ = folder_ / "state";
};

TEST_F(BackgroundFileTest, HoldsTheNewestText) {
  BackgroundFile file(path_);
  for (const char* text : {"one", "two", "three"}) file.write(text);
  ASSERT_TRUE(file.is_written(kLong_s));
  EXPECT_EQ(content(), "three");
  EXPECT_EQ(file.trouble(), "");
}

TEST_F(BackgroundFileTest, ItsEndWaitsForAPendingWrite) {
  { BackgroundFile(path_).write("the last words"); }
  EXPECT_EQ(content(), "the last words");
}

// The folder may be the mount point of a missing disk.
TEST_F(BackgroundFileTest, AMissingFolderIsATroubleAndIsNotMade) {
  fs::remove_all(folder_);
  BackgroundFile file(path_);
  file.write("state");
  EXPECT_FALSE(file.is_written(kLong_s));
  EXPECT_NE(file.trouble(), "");
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(BackgroundFileTest, WhatIsRemovedIsWrittenAgain) {
  BackgroundFile file(path_);
  file.write("state");
  ASSERT_TRUE(file.is_written(kLong_s));
  fs::remove(path_);
  EXPECT_TRUE(eventually([this] { return content() == "state"; }));
}

TEST_F(BackgroundFileTest, WithoutAPathNothingIsWritten) {
  BackgroundFile file("");
  file.write("state");
  EXPECT_TRUE(file.is_written(0.0)) << "nothing is pending";
  EXPECT_EQ(file.trouble(), "");
}

}  // namespace
}  // namespace ols
