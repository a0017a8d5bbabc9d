#include "tools/setup/membership.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/files/small_file.h"
#include "tests/unit/setup/answers_fixture.h"
#include "tests/unit/temp_dir.h"
#include "tools/key/site_files.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

class MembershipTest : public testing::Test {
 protected:
  MembershipTest() { fs::remove_all(root_); }
  ~MembershipTest() override { fs::remove_all(root_); }

  const std::string root_ = temp_dir() + "setup_membership_test_" +
                            testing::UnitTest::GetInstance()->current_test_info()->name();
  const Host host_{root_};
};

TEST_F(MembershipTest, TheCentreHasAListAndAKeyForEachProgramOnce) {
  fs::create_directories(root_);
  const std::string root = root_ + "/root.key";
  EXPECT_EQ(make_site(host_, "airfield", root).size(), 7U);
  const key::SiteFiles files{root, root_ + "/etc/ols/trust.toml"};
  const auto list = key::read_site(files, trust::read_root_key(root));
  EXPECT_EQ(list.members.size(), 7U);
  EXPECT_EQ(trust::read_member_key(root_ + "/etc/credstore/ols-cue.key").name, "cue");
  EXPECT_EQ(trust::read_member_key(root_ + "/etc/credstore/ols-fusion.key").name, "fusion");
  EXPECT_TRUE(make_site(host_, "airfield", root).empty());
  EXPECT_EQ(key::read_site(files, trust::read_root_key(root)).number, list.number);
}

TEST_F(MembershipTest, ACentreWhoseDiskIsLostBeginsAgainWithTheStick) {
  fs::create_directories(root_ + "/stick");
  const std::string root = root_ + "/stick/root.key";
  make_site(host_, "airfield", root);
  const auto secret = trust::read_root_key(root);
  const trust::PublicKey alfa = kSite.alfa.public_key();
  key::SiteFiles files{root, root_ + "/etc/ols/trust.toml"};
  key::enrol_in(files, {"alfa", trust::Role::kStation, alfa});
  EXPECT_EQ(key::copy_list(files), root_ + "/stick/root.trust.toml");
  const auto before = key::read_site(files, secret);
  fs::remove_all(root_ + "/etc");
  make_site(host_, "airfield", root);
  const auto list = key::read_site(files, secret);
  EXPECT_GT(list.number, before.number);
  EXPECT_EQ(list.find("alfa")->key, alfa) << "the tripods need not join again";
  EXPECT_NE(list.find("fusion")->key, before.find("fusion")->key);
  files.list = root_ + "/stick/root.trust.toml";
  EXPECT_EQ(key::read_site(files, secret).number, list.number) << "the copy is of the newest";
}

TEST_F(MembershipTest, AStationKeepsItsKeyAndTakesNoOtherSites) {
  const key::Invitation invitation{kSite.secret, kSite.root.public_key()};
  const std::string own = "/etc/credstore/ols-alfa.key";
  EXPECT_EQ(join_site(host_, "alfa", invitation), std::vector<std::string>{own});
  const std::string path = root_ + own;
  const auto key = trust::read_member_key(path);
  EXPECT_EQ(key.root, invitation.root);
  EXPECT_TRUE(join_site(host_, "alfa", invitation).empty());
  EXPECT_EQ(trust::read_member_key(path).seed, key.seed);
  EXPECT_THROW(join_site(host_, "alfa", {kSite.secret, kSite.stranger.public_key()}),
               std::invalid_argument);
}

TEST_F(MembershipTest, CentreAndStationHaveOneKeyForTheirTime) {
  const Host station(root_ + "/station");
  const std::string keys = "/etc/chrony/chrony.keys";
  for (const Host* host : {&host_, &station}) {
    host->folder("/etc/chrony", 0755);
    std::ofstream(host->path(keys)) << "1 MD5 HEX:00\n";
  }
  make_site(host_, "airfield", root_ + "/root.key");
  join_site(station, "alfa", key::invitation_of(trust::read_root_key(root_ + "/root.key")));
  const std::string text = read_small_file(host_.path(keys), 1000);
  EXPECT_EQ(text, read_small_file(station.path(keys), 1000));
  EXPECT_NE(text.find("\n7316 "), std::string::npos);
}

}  // namespace
}  // namespace ols::setup
