#include "base/trust/site_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "base/trust/signed_text.h"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/error_text.h"

namespace ols::trust {
namespace {

using testing::HasSubstr;

const Site kSite;
constexpr const char* kWanted = "geoid = \"egm08.gtx\"\n[station]\nlogic.max_age_s = 0.5\n";

SiteSettings head(std::int64_t number = 3) {
  SiteSettings settings;
  settings.site = "airfield";
  settings.number = number;
  return settings;
}

std::string error_of(const std::string& text) {
  return error_text<ConfigError>(
      [&] { read_settings(text, "site.toml", kSite.root.public_key()); });
}

std::string signed_body(const std::string& body) {
  return sign_text(body, "OLS-site-v1", kSite.root);
}

TEST(SiteSettings, AreReadBackAsTheyWereSigned) {
  const std::string text = sign_settings(head(), kWanted, "wanted.toml", kSite.root);
  const SiteSettings read = read_settings(text, "site.toml", kSite.root.public_key());
  EXPECT_EQ(read.site, "airfield");
  EXPECT_EQ(read.number, 3);
  EXPECT_EQ(read.geoid, "egm08.gtx");
  EXPECT_THAT(read.body, HasSubstr("logic.max_age_s = 0.5"));
}

TEST(SiteSettings, NoChangedByteIsBelieved) {
  const std::string text = sign_settings(head(), kWanted, "wanted.toml", kSite.root);
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {  // but the line's end
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_NE(error_of(changed), "") << i;
  }
  EXPECT_THAT(error_of(sign_settings(head(), kWanted, "w", kSite.stranger)),
              HasSubstr("site.toml: is not signed by this site's root"));
}

TEST(SiteSettings, ATrustListIsNone) {
  EXPECT_THAT(error_of(sign_list(kSite.list(), kSite.root)), HasSubstr("is not signed"));
}

TEST(SiteSettings, WhatIsWrongIsSaidByFileLineAndKey) {
  const std::string root = "root = \"" + to_hex(kSite.root.public_key()) + "\"\n";
  EXPECT_EQ(error_of(signed_body("site = \"s\"\nnumber = 1\n" + root)), "");
  EXPECT_THAT(error_of(signed_body("site = \"s\"\n" + root)), HasSubstr("number: is missing"));
  EXPECT_THAT(error_of(signed_body("site = \"s\"\nnumber = 0\n" + root)), HasSubstr("number"));
  EXPECT_THAT(error_of(signed_body("site = \"s\"\nnumber = 1\n" + root + "king = 1\n")),
              HasSubstr("site.toml:4: king"));
  EXPECT_THAT(error_of(signed_body("site = \"s\"\nnumber = 1\nroot = \"" +
                                   to_hex(kSite.stranger.public_key()) + "\"\n")),
              HasSubstr("root: is not this site's"));
  EXPECT_THAT(error_of(signed_body("[[")), HasSubstr("site.toml"));
}

TEST(SiteSettings, APersonWritesNoHeadAndNoOtherKeys) {
  for (const char* wanted : {"number = 7\n", "members = []\n", "geoid = \"\"\n", "geoid = 1\n"}) {
    EXPECT_THROW(sign_settings(head(), wanted, "wanted.toml", kSite.root), ConfigError) << wanted;
  }
  EXPECT_THROW(sign_settings(head(), "#" + std::string(kLargestSettings, 'x'), "w", kSite.root),
               ConfigError);
  EXPECT_NO_THROW(sign_settings(head(), "", "wanted.toml", kSite.root));
}

}  // namespace
}  // namespace ols::trust
