#include "tools/setup/never_older.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/files/small_file.h"
#include "tests/unit/temp_dir.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

class NeverOlderTest : public testing::Test {
 protected:
  NeverOlderTest() { fs::remove_all(host_.path("")); }
  ~NeverOlderTest() override { fs::remove_all(host_.path("")); }

  void put(const std::string& path, const std::string& text) const {
    fs::create_directories(fs::path(host_.path(path)).parent_path());
    std::ofstream(host_.path(path)) << text;
  }
  // What is there after a restore that brings `other` where `present` was.
  std::string after(const std::string& path, const std::string& present,
                    const std::string& other) const {
    put(path, present);
    const NeverOlder before(host_);
    put(path, other);
    before.put_back();
    return read_small_file(host_.path(path), 100);
  }

  const Host host_{temp_dir() + "never_older_test_" +
                   testing::UnitTest::GetInstance()->current_test_info()->name()};
};

TEST_F(NeverOlderTest, OfListsAndSettingsTheHigherNumberStays) {
  for (const char* path : {"/etc/ols/trust.toml", "/etc/ols/site.toml",
                           "/var/lib/ols/trust-fusion.toml", "/var/lib/ols/site-alfa.toml"}) {
    EXPECT_EQ(after(path, "number = 10\n", "number = 9\n"), "number = 10\n") << path;
    EXPECT_EQ(after(path, "number = 9\n", "number = 10\n"), "number = 10\n") << path;
  }
}

TEST_F(NeverOlderTest, WhatCannotBeReadGivesWay) {
  EXPECT_EQ(after("/etc/ols/trust.toml", "number = \n", "number = 1\n"), "number = 1\n");
  EXPECT_EQ(after("/etc/ols/trust.toml", "number = 1\n", "damaged"), "number = 1\n");
}

TEST_F(NeverOlderTest, MarksStay) {
  EXPECT_EQ(after("/var/lib/ols/heard-fusion", "new\n", "old\n"), "new\n");
}

TEST_F(NeverOlderTest, OtherFilesAreTheBackups) {
  EXPECT_EQ(after("/etc/ols/fusion.toml", "number = 2\n", "number = 1\n"), "number = 1\n");
}

TEST_F(NeverOlderTest, AFileThatIsGoneComesBack) {
  put("/etc/ols/trust.toml", "number = 3\n");
  const NeverOlder before(host_);
  fs::remove(host_.path("/etc/ols/trust.toml"));
  before.put_back();
  EXPECT_EQ(read_small_file(host_.path("/etc/ols/trust.toml"), 100), "number = 3\n");
}

}  // namespace
}  // namespace ols::setup
