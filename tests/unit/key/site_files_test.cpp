#include "tools/key/site_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "base/config/toml_config.h"
#include "base/files/small_file.h"
#include "tests/unit/folder_test.h"

namespace ols::key {
namespace {

namespace fs = std::filesystem;
using trust::Role;

class SiteFilesTest : public FolderTest<> {
 protected:
  const SiteFiles files_{folder_ + "/root.key", folder_ + "/trust.toml"};
};

TEST_F(SiteFilesTest, SettingsAreSignedUnderTheNextNumber) {
  make_site(files_, "airfield");
  const std::string wanted = folder_ + "/wanted.toml", made = folder_ + "/site.toml";
  std::ofstream(wanted) << "geoid = \"g\"\n";
  int checked = 0;
  const auto check = [&](const trust::SiteSettings& site, const std::string& name) {
    ++checked;
    if (site.geoid == "bad") throw ConfigError(name + ":1: geoid: is bad");
  };
  EXPECT_EQ(sign_settings_in(files_, wanted, made, 0, check), 1);
  EXPECT_EQ(sign_settings_in(files_, wanted, made, 0, check), 2);
  EXPECT_EQ(sign_settings_in(files_, wanted, made, 40, check), 41) << "the last ones are lost";
  EXPECT_EQ(checked, 3);
  std::ofstream(wanted) << "geoid = \"bad\"\n";
  EXPECT_THROW(sign_settings_in(files_, wanted, made, 0, check), ConfigError);
  const auto root = trust::SigningKey(trust::read_root_key(files_.root).seed).public_key();
  const auto read = trust::read_settings(read_small_file(made, 10'000), made, root);
  EXPECT_EQ(read.number, 41) << "nothing is written when it is refused";
  EXPECT_EQ(read.site, "airfield");
}

TEST_F(SiteFilesTest, AMemberIsEnrolledByItsOwnKeyOrGetsOne) {
  make_site(files_, "airfield");
  const std::string fusion = folder_ + "/ols-fusion.key", alfa = folder_ + "/ols-alfa.key";
  enrol_with_key(files_, {"fusion", Role::kFusion}, fusion);
  const auto root = trust::read_root_key(files_.root);
  EXPECT_EQ(trust::read_member_key(fusion).root, invitation_of(root).root);
  const auto key = make_member_key(alfa, "alfa", invitation_of(root));
  const auto list = enrol_in(files_, {"alfa", Role::kStation, key});
  EXPECT_EQ(list.number, 3);
  EXPECT_EQ(read_site(files_, root).find("alfa")->key, key);
  EXPECT_EQ(revoke_in(files_, "alfa").find("alfa"), nullptr);
  EXPECT_EQ(read_site(files_, root).find("alfa"), nullptr);
}

TEST_F(SiteFilesTest, AListThatIsKeptElsewhereHasACopyBesideTheRoot) {
  make_site(files_, "airfield");
  EXPECT_EQ(copy_list(files_), "") << "it is there itself";
  EXPECT_FALSE(restore_list(files_));
  fs::create_directories(folder_ + "/centre");
  const SiteFiles apart{folder_ + "/root.key", folder_ + "/centre/trust.toml"};
  EXPECT_FALSE(restore_list(apart)) << "there is no copy yet";
  fs::rename(files_.list, apart.list);
  EXPECT_EQ(copy_list(apart), folder_ + "/root.trust.toml");
  EXPECT_FALSE(restore_list(apart)) << "nothing is lost";
  fs::remove(apart.list);
  EXPECT_TRUE(restore_list(apart));
  EXPECT_EQ(read_site(apart, trust::read_root_key(apart.root)).number, 1);
}

TEST_F(SiteFilesTest, AListThatIsOlderThanItsCopyIsNeitherChangedNorCopied) {
  fs::create_directories(folder_ + "/centre");
  const SiteFiles apart{folder_ + "/root.key", folder_ + "/centre/trust.toml"};
  make_site(apart, "airfield");
  const std::string old = read_small_file(apart.list, 100'000);
  enrol_with_key(apart, {"alfa", Role::kStation}, folder_ + "/alfa.key");
  revoke_in(apart, "alfa");
  const std::string copy = copy_list(apart);
  std::ofstream(apart.list) << old;
  EXPECT_THROW(enrol_with_key(apart, {"bravo", Role::kStation}, folder_ + "/bravo.key"),
               ConfigError);
  EXPECT_FALSE(fs::exists(folder_ + "/bravo.key"));
  EXPECT_THROW(revoke_in(apart, "alfa"), ConfigError);
  EXPECT_THROW(static_cast<void>(copy_list(apart)), ConfigError);
  const auto root = trust::read_root_key(apart.root);
  EXPECT_EQ(read_site({apart.root, copy}, root).number, 3) << "the copy is as it was";
}

TEST_F(SiteFilesTest, WhatIsRefusedLeavesNothingBehind) {
  make_site(files_, "airfield");
  EXPECT_THROW(make_site(files_, "airfield"), std::system_error);
  const std::string key = folder_ + "/new.key";
  EXPECT_THROW(enrol_with_key(files_, {"a b", Role::kStation}, key), std::invalid_argument);
  EXPECT_FALSE(fs::exists(key));
  enrol_with_key(files_, {"alfa", Role::kStation}, key);
  EXPECT_THROW(make_member_key(key, "alfa", {}), std::system_error) << "a key is not overwritten";
  EXPECT_THROW(make_site({folder_ + "/r", folder_ + "/t"}, ""), std::invalid_argument);
  EXPECT_FALSE(fs::exists(folder_ + "/r"));
}

}  // namespace
}  // namespace ols::key
