#include "base/trust/key_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <system_error>

#include "base/config/toml_config.h"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/error_text.h"
#include "tests/unit/folder_test.h"

namespace ols::trust {
namespace {

using testing::HasSubstr;

class KeyFileTest : public FolderTest<> {
 protected:
  std::string error_of(const std::string& text) const {
    std::ofstream(path_) << text;
    ::chmod(path_.c_str(), 0600);
    return error_text<ConfigError>([&] { read_member_key(path_); });
  }

  const std::string path_ = folder_ + "/alfa.key";
};

TEST_F(KeyFileTest, IsReadBackAndOnlyItsOwnerMayReadIt) {
  write_member_key(path_, {"alfa", seed_of(1), seed_of(2), seed_of(3)});
  const MemberKey key = read_member_key(path_);
  EXPECT_EQ(key.name, "alfa");
  EXPECT_EQ(key.seed, seed_of(1));
  EXPECT_EQ(key.site_key, seed_of(2));
  EXPECT_EQ(key.root, seed_of(3));
  struct stat status {};
  ASSERT_EQ(::stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(KeyFileTest, TheRootsToo) {
  write_root_key(path_, {"airfield", seed_of(1), seed_of(2)});
  EXPECT_EQ(read_root_key(path_).site, "airfield");
  EXPECT_EQ(read_root_key(path_).site_key, seed_of(2));
  EXPECT_THROW(read_member_key(path_), ConfigError);
}

TEST_F(KeyFileTest, AKeyIsNeverOverwritten) {
  write_member_key(path_, {"alfa", seed_of(1), seed_of(2), seed_of(3)});
  EXPECT_THROW(write_member_key(path_, {"alfa", seed_of(7), seed_of(2), seed_of(3)}),
               std::system_error);
  EXPECT_EQ(read_member_key(path_).seed, seed_of(1));
}

TEST_F(KeyFileTest, WhatOthersCanReadIsNoSecret) {
  write_member_key(path_, {"alfa", seed_of(1), seed_of(2), seed_of(3)});
  ::chmod(path_.c_str(), 0644);
  EXPECT_THROW(read_member_key(path_), ConfigError);
  ::chmod(path_.c_str(), 0440);
  EXPECT_NO_THROW(read_member_key(path_)) << "as systemd hands credentials over";
}

TEST_F(KeyFileTest, WhatIsWrongIsSaidByFileLineAndKey) {
  EXPECT_THAT(error_of("name = \"a\"\nseed = \"12\"\n"), HasSubstr("alfa.key:2: seed: must be 64"));
  EXPECT_THAT(error_of("name = \"a b\"\n"), HasSubstr("name: must be"));
  EXPECT_THAT(error_of("nam = \"a\"\n"), HasSubstr("alfa.key:1: nam: unknown key"));
  EXPECT_THROW(read_member_key(folder_ + "/nothing"), std::system_error);
}

}  // namespace
}  // namespace ols::trust
