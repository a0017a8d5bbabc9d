#include "base/trust/site_keeper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/config/toml_config.h"
#include "base/files/small_file.h"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/folder_test.h"

namespace ols::trust {
namespace {

using testing::HasSubstr;

const Site kSite;

std::string told(std::int64_t number, const SigningKey& by = kSite.root) {
  SiteSettings head;
  head.site = "airfield";
  head.number = number;
  return sign_settings(head, "geoid = \"g" + std::to_string(number) + "\"\n", "wanted", by);
}

class SiteKeeperTest : public FolderTest<> {
 protected:
  SiteKeeper keeper(SettingsCheck check = {}) const {
    return {kSite.root.public_key(), {given_, kept_}, std::move(check)};
  }
  static void put(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::trunc) << text;
  }

  const std::string given_ = folder_ + "/site.toml", kept_ = folder_ + "/site-alfa.toml";
};

TEST_F(SiteKeeperTest, WhatIsHeardIsInForceAndOutlastsARestart) {
  {
    SiteKeeper first = keeper();
    EXPECT_EQ(first.number(), 0);
    EXPECT_EQ(first.trouble(), "");
    first.hear(told(3));
    EXPECT_EQ(first.settings().geoid, "g3");
    first.look();
  }
  EXPECT_EQ(read_small_file(kept_, 10'000), told(3)) << "byte by byte";
  EXPECT_EQ(keeper().number(), 3);
}

TEST_F(SiteKeeperTest, AnOlderOneNeverReplacesANewerOne) {
  SiteKeeper one = keeper();
  one.hear(told(3));
  one.hear(told(2));
  EXPECT_EQ(one.number(), 3);
  EXPECT_THAT(one.trouble(), HasSubstr("OLS_SITE: number 2 does not replace 3"));
  one.hear(told(3));
  EXPECT_NE(one.trouble(), "") << "still to be seen";
  for (int i = 0; i < 5; ++i) one.hear(told(3));
  EXPECT_EQ(one.trouble(), "") << "what is in force is told again and again";
  put(given_, told(2));
  one.look();
  EXPECT_EQ(one.number(), 3) << "nor from a file";
  EXPECT_THAT(one.trouble(), HasSubstr("site.toml: number 2"));
}

TEST_F(SiteKeeperTest, WhatCannotBeUsedIsRefusedWithItsReason) {
  SiteKeeper one = keeper([](const SiteSettings& site, const std::string& name) {
    if (site.geoid == "g5") throw ConfigError(name + ":4: geoid: is bad");
  });
  one.hear(told(4));
  one.hear(told(9, kSite.stranger));
  EXPECT_THAT(one.trouble(), HasSubstr("is not signed by this site's root"));
  one.hear("nonsense");
  EXPECT_THAT(one.trouble(), HasSubstr("there is no line"));
  one.hear(told(5));
  EXPECT_THAT(one.trouble(), HasSubstr("geoid: is bad"));
  EXPECT_EQ(one.number(), 4);
  one.hear(told(6));
  EXPECT_EQ(one.number(), 6);
}

// Otherwise whoever records the bus could play the older settings back until the next start.
TEST_F(SiteKeeperTest, ANumberThatTheRootHasSignedIsNotUndercutThoughItCouldNotBeUsed) {
  SiteKeeper one = keeper([](const SiteSettings& site, const std::string& name) {
    if (site.geoid == "g5") throw ConfigError(name + ":4: geoid: is bad");
  });
  one.hear(told(5));
  EXPECT_EQ(one.number(), 0);
  one.hear(told(4));
  EXPECT_EQ(one.number(), 0);
  EXPECT_THAT(one.trouble(), HasSubstr("number 4 does not replace 5"));
}

TEST_F(SiteKeeperTest, AGivenFileThatCannotBeReadIsSaid) {
  put(given_, told(1));
  SiteKeeper one = keeper();
  std::filesystem::remove(given_);
  std::filesystem::create_directory(given_);
  one.look();
  EXPECT_THAT(one.trouble(), HasSubstr("site.toml"));
  EXPECT_EQ(one.number(), 1);
}

TEST_F(SiteKeeperTest, TheFileAtTheCentreIsWatchedAndTold) {
  put(given_, told(1));
  SiteKeeper one = keeper();
  EXPECT_EQ(one.to_tell(100.0), told(1));
  EXPECT_EQ(one.to_tell(101.0), std::nullopt) << "told just now";
  put(given_, told(2));
  one.look();
  EXPECT_EQ(one.to_tell(103.0), told(2));
  put(given_, "nonsense");
  one.look();
  EXPECT_THAT(one.trouble(), HasSubstr("site.toml"));
  EXPECT_EQ(one.to_tell(106.0), told(2)) << "the last good ones stand";
}

TEST_F(SiteKeeperTest, DamagedKeptOnesAreSaidAndWrittenAgain) {
  put(kept_, "nonsense");
  SiteKeeper one = keeper();
  EXPECT_EQ(one.number(), 0);
  one.hear(told(2));
  one.look();
  EXPECT_EQ(keeper().number(), 2);
}

TEST_F(SiteKeeperTest, WithoutAFolderNothingIsKept) {
  SiteKeeper one(kSite.root.public_key(), {given_, ""}, {});
  one.hear(told(2));
  one.look();
  EXPECT_EQ(one.trouble(), "");
  EXPECT_FALSE(std::filesystem::exists(kept_));
}

}  // namespace
}  // namespace ols::trust
