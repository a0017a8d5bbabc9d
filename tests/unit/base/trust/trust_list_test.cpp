#include "base/trust/trust_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/error_text.h"

namespace ols::trust {
namespace {

using testing::HasSubstr;

const Site kSite;

std::string error_of(const std::string& text) {
  return error_text<ConfigError>([&] { read_list(text, "trust.toml", kSite.root.public_key()); });
}

// Signed, whatever it says.
std::string signed_body(const std::string& body) {
  const std::string text = "OLS-trust-v1" + body;
  const Signature signature =
      kSite.root.sign({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  return body + "# signature " + to_hex(signature) + "\n";
}

std::string head() {
  return "site = \"s\"\nnumber = 2\nroot = \"" + to_hex(kSite.root.public_key()) + "\"\n";
}

std::string member(const std::string& name, const SigningKey& key, const char* role = "station") {
  return "[[member]]\nname = \"" + name + "\"\nrole = \"" + role + "\"\nkey = \"" +
         to_hex(key.public_key()) + "\"\n";
}

TEST(TrustList, IsReadBackAsItWasSigned) {
  TrustList list = kSite.list(3);
  list.members[1].revoked = true;
  const TrustList read = read_list(sign_list(list, kSite.root), "t", kSite.root.public_key());
  EXPECT_EQ(read.site, "airfield");
  EXPECT_EQ(read.number, 3);
  ASSERT_EQ(read.members.size(), 4U);
  EXPECT_EQ(read.members[0].key, kSite.alfa.public_key());
  EXPECT_EQ(read.members[3].role, Role::kOperator);
  EXPECT_NE(read.find("alfa"), nullptr);
  EXPECT_EQ(read.find("bravo"), nullptr) << "revoked";
  EXPECT_EQ(read.find("nobody"), nullptr);
}

TEST(TrustList, NoChangedByteIsBelieved) {
  const std::string text = sign_list(kSite.list(), kSite.root);
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {  // but the line's end
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_NE(error_of(changed), "") << i;
  }
  EXPECT_NE(error_of(text.substr(0, text.size() - 20)), "");
  EXPECT_NE(error_of("x = 1\n" + text), "");
}

TEST(TrustList, AnotherRootsListIsRefused) {
  const std::string other = sign_list(kSite.list(), kSite.stranger);
  EXPECT_THAT(error_of(other), HasSubstr("trust.toml: is not signed by this site's root"));
  TrustList claims = kSite.list();
  claims.root = kSite.stranger.public_key();
  EXPECT_THAT(error_of(sign_list(claims, kSite.root)), HasSubstr("root: is not this site's"));
}

TEST(TrustList, WhatIsWrongIsSaidByFileLineAndKey) {
  EXPECT_EQ(error_of(signed_body(head() + member("a", kSite.alfa))), "");
  const std::string bad_role = signed_body(head() + member("a", kSite.alfa, "a king"));
  EXPECT_THAT(error_of(bad_role), HasSubstr("trust.toml:6: "));
  EXPECT_THAT(error_of(bad_role), HasSubstr("role: must be"));
  EXPECT_THAT(error_of(signed_body(head() + member("a b", kSite.alfa))),
              HasSubstr("name: must be"));
  EXPECT_THAT(error_of(signed_body(head() + member("a", kSite.alfa) + member("a", kSite.bravo))),
              HasSubstr("\"a\" is there twice"));
  EXPECT_THAT(error_of(signed_body(head() + member("a", kSite.alfa) + member("b", kSite.alfa))),
              HasSubstr("is that of another member"));
  EXPECT_THAT(error_of(signed_body(head() + "extra = 1\n")), HasSubstr("extra"));
  EXPECT_THAT(error_of(signed_body("site = \"s\"\n")), HasSubstr("root"));
  EXPECT_THAT(error_of("site = \"s\"\n"), HasSubstr("there is no line"));
  EXPECT_THAT(error_of("# signature 12\n"), HasSubstr("128 hexadecimal digits"));
}

TEST(TrustList, AMemberOfANewerRoleIsKeptButMaySendNothing) {
  const std::string text =
      signed_body(head() + member("a", kSite.alfa, "king") + member("b", kSite.bravo));
  const TrustList list = read_list(text, "t");
  ASSERT_NE(list.find("a"), nullptr);
  EXPECT_EQ(list.find("a")->role, Role::kUnknown);
  EXPECT_EQ(list.strange_members(), "a (king)");
  for (const char* channel : {"OLS_BEARING_a", "OLS_STATUS_a", "OLS_TARGET", "OLS_TRUST"}) {
    EXPECT_FALSE(may_send(Role::kUnknown, "a", *rule_of(channel))) << channel;
  }
  const TrustList again = read_list(sign_list(list, kSite.root), "t");
  EXPECT_EQ(again.strange_members(), "a (king)") << "whoever signs it again keeps its word";
  EXPECT_EQ(kSite.list().strange_members(), "");
}

TEST(TrustList, NamesTheStationsThatAreNotRevoked) {
  TrustList list = Site().list();
  EXPECT_EQ(list.stations(), (std::vector<std::string>{"alfa", "bravo"}));
  list.members[0].revoked = true;
  EXPECT_EQ(list.stations(), (std::vector<std::string>{"bravo"}));
}

TEST(TrustList, SaysInOneLineWhoIsRevoked) {
  TrustList list = kSite.list(7);
  const std::string all = std::to_string(list.members.size());
  EXPECT_EQ(list.in_one_line(), "trust list 7: " + all + " members");
  list.members[0].revoked = list.members[1].revoked = true;
  EXPECT_EQ(list.in_one_line(), "trust list 7: " + std::to_string(list.members.size() - 2) +
                                    " members, revoked: " + list.members[0].name + ", " +
                                    list.members[1].name);
}

TEST(TrustList, AKeyThatWasExchangedStandsTwiceUnderItsName) {
  const std::string text =
      signed_body(head() + member("a", kSite.alfa) + "revoked = true\n" + member("a", kSite.bravo));
  const TrustList list = read_list(text, "t");
  ASSERT_NE(list.find("a"), nullptr);
  EXPECT_EQ(list.find("a")->key, kSite.bravo.public_key());
}

}  // namespace
}  // namespace ols::trust
