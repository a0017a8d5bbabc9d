#include "tools/setup/host.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/small_file.h"
#include "tests/unit/temp_dir.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

class HostTest : public testing::Test {
 protected:
  HostTest() { fs::remove_all(root_); }
  ~HostTest() override { fs::remove_all(root_); }

  std::string text(const std::string& path) const { return read_small_file(root_ + path, 10'000); }

  const std::string root_ = temp_dir() + "setup_host_test_" +
                            testing::UnitTest::GetInstance()->current_test_info()->name();
  const Host host_{root_};
};

TEST_F(HostTest, WhatAPersonHasChangedOutlastsTheNextRuns) {
  const PlannedFile config{"/etc/ols/alfa.toml", "a = 1\nb = 2\n"};
  const PlannedFile route{"/etc/ols/bus.env", "X=eth0\n", false};
  host_.write({config, route});
  EXPECT_EQ(text(config.path), config.text);
  std::ofstream(root_ + config.path) << "# mine\na = 5\nb = 2\n";
  std::ofstream(root_ + route.path) << "X=eth7\n";
  host_.write({config, route});
  host_.write({{config.path, "a = 1\nb = 3\n"}, {route.path, "X=eth1\n", false}});
  EXPECT_EQ(text(config.path), "# mine\na = 5\nb = 3\n");
  EXPECT_EQ(text(route.path), "X=eth7\n");
  host_.write({{config.path, "a = 1\nb = 3\n"}});
  EXPECT_EQ(text(config.path), "# mine\na = 5\nb = 3\n");
}

TEST_F(HostTest, WhatWasThereBeforeTheFirstRunIsNotTouched) {
  fs::create_directories(root_ + "/etc/ols");
  std::ofstream(root_ + "/etc/ols/alfa.toml") << "own = 1\n";
  for (const char* value : {"1", "2"}) {
    host_.write({{"/etc/ols/alfa.toml", std::string("a = ") + value + "\n"}});
    EXPECT_EQ(text("/etc/ols/alfa.toml"), "own = 1\n");
  }
}

TEST_F(HostTest, APackagesFileInWhichNobodyChoseAnythingIsReplaced) {
  const std::string path = "/etc/gpsd";
  const PlannedFile wanted{path, "DEVICES=\"/dev/gnss\"\n", false, "DEVICES=\"\"\n"};
  std::ofstream(host_.folder("/etc", 0755) + "/gpsd") << "# Debian's\nDEVICES=\"\"\n";
  host_.write({wanted});
  EXPECT_EQ(read_small_file(host_.path(path), 1000), wanted.text);
  std::ofstream(host_.path(path)) << "DEVICES=\"/dev/other\"\n";
  host_.write({wanted});
  EXPECT_EQ(read_small_file(host_.path(path), 1000), "DEVICES=\"/dev/other\"\n");
}

TEST_F(HostTest, AFolderOfSecretsIsClosed) {
  host_.folder("/etc/credstore", 0700);
  EXPECT_EQ(fs::status(root_ + "/etc/credstore").permissions(), fs::perms::owner_all);
}

TEST(Run, GivesTheStatusOfTheProgram) {
  EXPECT_EQ(run({"true"}), 0);
  EXPECT_EQ(run({"sh", "-c", "exit 3"}), 3);
  EXPECT_EQ(run({"/nonexistent/program"}), -1);
}

}  // namespace
}  // namespace ols::setup
