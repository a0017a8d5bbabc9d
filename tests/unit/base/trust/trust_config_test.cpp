#include "base/trust/trust_config.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/config/config_section.h"

namespace ols::trust {
namespace {

TEST(TrustConfig, TheFileComesBeforeTheEnvironment) {
  TrustConfig config;
  EXPECT_EQ(mode_of(config, {}), Mode::kOff);
  EXPECT_EQ(mode_of(config, {.mode = "require"}), Mode::kRequire);
  ConfigFile file("mode = \"observe\"\nkey = \"/k\"\nlist = \"/l\"\n", "t");
  config::read(trust_section(config), file.root());
  const Environment all{"require", "/keys", "/credentials", ""};
  EXPECT_EQ(mode_of(config, all), Mode::kObserve);
  EXPECT_EQ(key_path(config, all, "alfa"), "/k");
  EXPECT_EQ(list_path(config, all), "/l");
}

TEST(TrustConfig, AWordThatIsNoModeIsNotTakenForOff) {
  EXPECT_THROW(mode_of({}, {.mode = "required"}), std::invalid_argument);
  EXPECT_THROW(mode_of({}, {.mode = "default"}), std::invalid_argument);
}

TEST(TrustConfig, KeysAreSoughtWhereUnitsAndTestsHaveThem) {
  EXPECT_EQ(key_path({}, {}, "alfa"), "/etc/credstore/ols-alfa.key");
  EXPECT_EQ(key_path({}, {.keys = "/keys"}, "alfa"), "/keys/alfa.key");
  EXPECT_EQ(key_path({}, {.keys = "/keys", .credentials = "/c"}, "alfa"), "/c/ols-key");
  EXPECT_EQ(list_path({}, {}), "/etc/ols/trust.toml");
  EXPECT_EQ(list_path({}, {.keys = "/keys"}), "/keys/trust.toml");
  EXPECT_EQ(settings_path({}, {}), "/etc/ols/site.toml");
  TrustConfig elsewhere;
  elsewhere.list = "/l/list.toml";
  EXPECT_EQ(settings_path(elsewhere, {}), "/l/site.toml");
  EXPECT_EQ(kept_path({}, "site", "alfa"), "");
  EXPECT_EQ(kept_path({.state = "/s"}, "site", "alfa"), "/s/site-alfa.toml");
}

}  // namespace
}  // namespace ols::trust
