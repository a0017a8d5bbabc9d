#include "tools/setup/backup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/files/small_file.h"
#include "base/trust/key_file.h"
#include "tests/unit/folder_test.h"
#include "tools/setup/site_time.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

class BackupTest : public FolderTest<> {
 protected:
  BackupTest() { fs::create_directories(folder_ + "/new"); }

  void put(const std::string& path, const std::string& text) const {
    const fs::path there = folder_ + "/old" + path;
    fs::create_directories(there.parent_path());
    std::ofstream(there) << text;
  }

  const Host old_{folder_ + "/old"}, new_{folder_ + "/new"};
  const std::string file_ = folder_ + "/alfa.backup";
};

TEST_F(BackupTest, AStationComesBackOnAnotherComputer) {
  put("/etc/ols/alfa.toml", "id = \"alfa\"\n");
  put("/etc/credstore/ols-alfa.key.old", "secret\n");
  put("/etc/credstore/other.key", "not ours\n");
  put("/etc/passwd", "not ours\n");
  put("/var/lib/ols/calibrations/7/setup.toml", "x = 1\n");
  back_up(old_, file_);
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_THROW(back_up(old_, file_), std::runtime_error) << "another backup is not overwritten";
  restore(new_, file_);
  EXPECT_EQ(read_small_file(folder_ + "/new/etc/ols/alfa.toml", 100), "id = \"alfa\"\n");
  EXPECT_EQ(read_small_file(folder_ + "/new/etc/credstore/ols-alfa.key.old", 100), "secret\n");
  EXPECT_TRUE(fs::exists(folder_ + "/new/var/lib/ols/calibrations/7/setup.toml"));
  EXPECT_FALSE(fs::exists(folder_ + "/new/etc/credstore/other.key"));
  EXPECT_FALSE(fs::exists(folder_ + "/new/etc/passwd"));
}

TEST_F(BackupTest, WhatAPersonHasChangedAndEnabledInSystemdComesBack) {
  const std::string system = "/etc/systemd/system/";
  const std::string drop_in = system + "ols-station@.service.d/cameras.conf";
  const std::string wants = system + "multi-user.target.wants/";
  put("/etc/ols/alfa.toml", "id = \"alfa\"\n");
  put("/etc/ols/spare.toml", "id = \"spare\"\n");
  put(drop_in, "[Service]\n");
  put(system + "ssh.service.d/own.conf", "not ours\n");
  fs::create_directories(old_.path(wants));
  for (const char* unit : {"ols-ptp@eth1.service", "ols-station@alfa.service", "ssh.service"}) {
    fs::create_symlink(std::string("/lib/systemd/system/") + unit, old_.path(wants + unit));
  }
  back_up(old_, file_);
  EXPECT_THAT(restore(new_, file_),
              UnorderedElementsAre("ols-ptp@eth1.service", "ols-station@alfa.service"))
      << "not the spare one, which was not enabled";
  EXPECT_TRUE(fs::exists(new_.path(drop_in)));
  EXPECT_TRUE(fs::is_symlink(new_.path(wants + "ols-ptp@eth1.service")));
  EXPECT_FALSE(fs::exists(new_.path(system + "ssh.service.d")));
  EXPECT_FALSE(fs::is_symlink(new_.path(wants + "ssh.service")));
}

TEST_F(BackupTest, OfTheStatesFolderItHasWhatAStationNeeds) {
  const std::string states = "/var/lib/ols/";
  const std::vector<std::string> needed{"alfa.hold", "alfa.pose", "trust-alfa.toml",
                                        "calibrations/alfa/7/setup.toml"};
  const std::vector<std::string> large{"maps/site.pmtiles", "exports/site.kml",
                                       "recordings/20260101_x/1.png"};
  for (const std::string& name : needed) put(states + name, "");
  for (const std::string& name : large) put(states + name, "");
  back_up(old_, file_);
  restore(new_, file_);
  for (const std::string& name : needed) EXPECT_TRUE(fs::exists(new_.path(states + name))) << name;
  for (const std::string& name : large) EXPECT_FALSE(fs::exists(new_.path(states + name))) << name;
}

TEST_F(BackupTest, AnyNumberOfFilesComesBack) {
  put("/etc/ols/alfa.toml", "id = \"alfa\"\n");
  const std::string deep = "/var/lib/ols/calibrations/" + std::string(150, 'x') + "/";
  for (int i = 0; i < 600; ++i) put(deep + std::to_string(i), "");  // 100 kB of names
  back_up(old_, file_);
  restore(new_, file_);
  EXPECT_TRUE(fs::exists(folder_ + "/new" + deep + "599"));
}

TEST_F(BackupTest, ANewerTrustListStays) {
  put("/etc/ols/trust.toml", "number = 4\n");
  put("/etc/ols/fusion.toml", "old\n");
  back_up(old_, file_);
  restore(new_, file_);
  EXPECT_EQ(read_small_file(new_.path("/etc/ols/trust.toml"), 100), "number = 4\n");
  std::ofstream(new_.path("/etc/ols/trust.toml")) << "number = 10\n";
  std::ofstream(new_.path("/etc/ols/fusion.toml")) << "new\n";
  restore(new_, file_);
  EXPECT_EQ(read_small_file(new_.path("/etc/ols/trust.toml"), 100), "number = 10\n");
  EXPECT_EQ(read_small_file(new_.path("/etc/ols/fusion.toml"), 100), "old\n");
}

TEST_F(BackupTest, TheTimesKeyIsMadeAgain) {
  const trust::MemberKey key{"alfa", trust::draw_secret(), trust::draw_secret(), {}};
  fs::create_directories(folder_ + "/old/etc/credstore");
  trust::write_member_key(folder_ + "/old/etc/credstore/ols-alfa.key", key);
  put("/etc/ols/alfa.toml", "id = \"alfa\"\n");
  back_up(old_, file_);
  const std::string keys = folder_ + "/new/etc/chrony/chrony.keys";
  fs::create_directories(folder_ + "/new/etc/chrony");
  std::ofstream(keys) << "1 SHA256 HEX:00\n";
  restore(new_, file_);
  EXPECT_EQ(read_small_file(keys, 1000), with_time_key("1 SHA256 HEX:00\n", key.site_key));
}

TEST_F(BackupTest, AnythingElseIsRefusedBeforeItIsWritten) {
  put("/etc/ols/alfa.toml", "id = \"alfa\"\n");
  put("/etc/passwd", "root\n");
  ASSERT_EQ(run({"tar", "-czf", file_, "-C", folder_ + "/old", "etc"}), 0);
  EXPECT_THROW(restore(new_, file_), std::runtime_error);
  EXPECT_TRUE(fs::is_empty(folder_ + "/new"));
  std::ofstream(folder_ + "/text") << "no archive\n";
  EXPECT_THROW(restore(new_, folder_ + "/text"), std::runtime_error);
  EXPECT_THROW(back_up(new_, folder_ + "/empty"), std::runtime_error) << "nothing is there";
}

TEST(Backup, HoldsNoPathThatLeavesIt) {
  EXPECT_TRUE(is_of_backup("etc/ols/alfa.toml"));
  for (const char* bad :
       {"etc/ols/../passwd", "/etc/ols/alfa.toml", "etc/passwd", "etc/credstore/x"}) {
    EXPECT_FALSE(is_of_backup(bad)) << bad;
  }
}

TEST(Backup, TheConfigurationSaysWhichServicesThereWere) {
  EXPECT_THAT(units_of({"etc/ols/", "etc/ols/alfa.toml", "etc/ols/trust.toml", "etc/ols/bus.env"}),
              ElementsAre("ols-bus.service", "ols-time.service", "ols-station@alfa.service"));
  EXPECT_THAT(units_of({"etc/ols/fusion.toml", "var/lib/ols/x.toml"}),
              ElementsAre("ols-bus.service", "ols-time.service", "ols-fusion.service"));
  EXPECT_THAT(units_of({"etc/ols/exporter.toml", "etc/ols/export.toml"}),
              ElementsAre("ols-bus.service", "ols-time.service", "ols-exporter.service",
                          "ols-export.service"));
  EXPECT_THAT(units_of({"etc/ols/cue.toml", "etc/ols/site.toml"}),
              ElementsAre("ols-bus.service", "ols-time.service", "ols-cue.service"));
  EXPECT_TRUE(units_of({"etc/ols/bus.env"}).empty());
}

TEST(Backup, WhatWasEnabledGoesBeforeWhatIsConfigured) {
  const std::string wants = "etc/systemd/system/multi-user.target.wants/";
  EXPECT_THAT(units_of({"etc/ols/alfa.toml", wants + "gpsd.service", wants + "ols-bus.service"}),
              ElementsAre("gpsd.service", "ols-bus.service"));
  EXPECT_THAT(units_of({"etc/ols/alfa.toml", wants + "gpsd.service"}),
              ElementsAre("gpsd.service", "ols-bus.service", "ols-time.service",
                          "ols-station@alfa.service"))
      << "of others' programs alone";
}

}  // namespace
}  // namespace ols::setup
