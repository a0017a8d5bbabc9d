#include "tools/setup/host.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/files/small_file.h"
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
  EXPECT_EQ(host_.write({config, route}), (std::vector<std::string>{config.path, route.path}));
  EXPECT_EQ(text(config.path), config.text);
  std::ofstream(root_ + config.path) << "# mine\na = 5\nb = 2\n";
  std::ofstream(root_ + route.path) << "X=eth7\n";
  EXPECT_EQ(host_.write({config, route}), std::vector<std::string>{});
  const PlannedFile other{route.path, "X=eth1\n", false};
  EXPECT_EQ(host_.write({{config.path, "a = 1\nb = 3\n"}, other}),
            std::vector<std::string>{config.path});
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

// A systemctl that knows no gpsd.
TEST_F(HostTest, OneUnitThatDoesNotStartKeepsNoOtherFromIt) {
  const std::string program = host_.folder("/bin", 0755) + "/systemctl";
  std::ofstream(program) << "#!/bin/sh\necho \"$*\" >>" << root_
                         << "/asked\n[ \"$3\" != gpsd.service ]\n";
  fs::permissions(program, fs::perms::owner_all);
  const std::string before = ::getenv("PATH");
  ::setenv("PATH", (root_ + "/bin:" + before).c_str(), 1);
  const auto failed = start({"ols-bus.service", "gpsd.service", "ols-station@alfa.service"});
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(failed, std::vector<std::string>{"gpsd.service"});
  EXPECT_EQ(text("/asked"),
            "daemon-reload\nenable --now ols-bus.service\nenable --now gpsd.service\n"
            "enable --now ols-station@alfa.service\ntry-restart chrony.service gpsd.service\n");
}

TEST(Readers, AreWhoReadsTheFileAtTheStart) {
  const std::vector<std::string> units{"ols-bus.service", "ols-fusion.service", "gpsd.service",
                                       "ols-station@alfa.service"};
  using Found = std::vector<std::string>;
  EXPECT_EQ(readers(units, {"/etc/ols/alfa.toml"}), Found{"ols-station@alfa.service"});
  EXPECT_EQ(readers(units, {"/etc/credstore/ols-fusion.key"}), Found{"ols-fusion.service"});
  EXPECT_EQ(readers(units, {"/etc/ols/bus.env"}),
            (Found{"ols-bus.service", "ols-fusion.service", "ols-station@alfa.service"}));
  EXPECT_EQ(readers(units, {"/etc/chrony/conf.d/ols-site.conf", "/etc/ols/bravo.toml"}), Found{});
}

TEST(Trouble, IsWhatHasNotStartedAndWhatTheDoctorFinds) {
  EXPECT_EQ(trouble({}, 0), "");
  EXPECT_EQ(trouble({}, 1), "") << "warnings";
  EXPECT_EQ(trouble({}, 2), "ols-doctor finds failures");
  EXPECT_EQ(trouble({}, -1), "ols-doctor cannot run");
  EXPECT_EQ(trouble({"a.service", "b.service"}, 1), "not started: a.service, b.service");
  EXPECT_EQ(trouble({"a.service"}, 3), "not started: a.service; ols-doctor cannot run");
}

TEST(Run, GivesTheStatusOfTheProgram) {
  EXPECT_EQ(run({"true"}), 0);
  EXPECT_EQ(run({"sh", "-c", "exit 3"}), 3);
  EXPECT_EQ(run({"/nonexistent/program"}), -1);
  EXPECT_EQ(run({"sh", "-c", "exit 127"}), -1);
}

}  // namespace
}  // namespace ols::setup
