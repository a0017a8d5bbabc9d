#include "base/trust/trust_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "base/config/config_section.h"
#include "base/trust/trust_options.h"
#include "base/trust/trust_words.h"
#include "tests/unit/error_text.h"

namespace ols::trust {
namespace {

using testing::HasSubstr;

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

Mode mode_by(const std::string& words, const char* environment) {
  ::setenv("OLS_TRUST", environment, 1);
  CLI::App app;
  TrustConfig config;
  add_trust_options(app, config);
  app.parse(words);
  ::unsetenv("OLS_TRUST");
  return config.mode;
}

TEST(TrustOptions, WhoNamesAKeyRequiresSignatures) {
  EXPECT_EQ(mode_by("--key /nonexistent/bert.key", ""), Mode::kRequire);
  EXPECT_EQ(mode_by("", ""), Mode::kDefault);  // no operator's key on a computer that runs tests
}

TEST(TrustOptions, WhatIsSaidGoesFirst) {
  EXPECT_EQ(mode_by("--key /nonexistent/bert.key --trust off", ""), Mode::kOff);
  EXPECT_EQ(mode_by("--trust observe --key /nonexistent/bert.key", ""), Mode::kObserve);
  EXPECT_EQ(mode_by("--key /nonexistent/bert.key", "observe"), Mode::kDefault);  // as that says
}

TEST(TrustWords, ANameIsShortAndOfPlainCharacters) {
  for (const char* good : {"a", "Alfa-2_b", "12345678901234567890123456789012"}) {
    EXPECT_NO_THROW(require_member_name(good)) << good;
  }
  for (const char* bad : {"", "a b", "a/b", "\xc3\xa4", "123456789012345678901234567890123"}) {
    EXPECT_THROW(require_member_name(bad), std::invalid_argument) << bad;
  }
}

TEST(TrustWords, AnErrorNamesFileLineAndKey) {
  ConfigFile file("name = \"a b\"\nseed = \"12\"\n", "alfa.key");
  const auto complaint = [&](auto read, const char* key) -> std::string {
    return error_text<ConfigError>([&] { read(file.root(), key); }, "none");
  };
  EXPECT_THAT(complaint(read_name, "name"), HasSubstr("alfa.key:1: name: must be 1 to 32"));
  EXPECT_THAT(complaint(read_hex, "seed"), HasSubstr("alfa.key:2: seed: must be 64"));
  EXPECT_THAT(complaint(read_hex, "absent"), HasSubstr("must be 64"));
}

TEST(TrustWords, HexadecimalDigitsAreBytes) {
  ConfigFile file("seed = \"" + std::string(62, '0') + "a1\"\n", "alfa.key");
  EXPECT_EQ(read_hex(file.root(), "seed")[31], 0xa1);
}

}  // namespace
}  // namespace ols::trust
