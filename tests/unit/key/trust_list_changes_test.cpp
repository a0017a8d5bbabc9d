#include "tools/key/trust_list_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/base/trust/site_fixture.h"

namespace ols::key {
namespace {

using testing::HasSubstr;
using trust::Role;

const trust::Site kSite;

trust::TrustList begun() { return new_list("airfield", kSite.root.public_key()); }

TEST(SiteBook, EachChangeHasAHigherNumber) {
  const auto with = enrol(begun(), {"alfa", Role::kStation, kSite.alfa.public_key()});
  EXPECT_EQ(with.number, 2);
  ASSERT_NE(with.find("alfa"), nullptr);
  const auto without = revoke(with, "alfa");
  EXPECT_EQ(without.number, 3);
  EXPECT_EQ(without.find("alfa"), nullptr);
  ASSERT_EQ(without.members.size(), 1U);
  EXPECT_TRUE(without.members[0].revoked) << "a revoked key stays named";
}

TEST(SiteBook, AnExchangedKeyRevokesTheOldOne) {
  auto list = enrol(begun(), {"alfa", Role::kStation, kSite.alfa.public_key()});
  list = enrol(list, {"alfa", Role::kStation, kSite.bravo.public_key()});
  ASSERT_EQ(list.members.size(), 2U);
  EXPECT_TRUE(list.members[0].revoked);
  EXPECT_EQ(list.find("alfa")->key, kSite.bravo.public_key());
  EXPECT_NO_THROW(trust::read_list(sign_list(list, kSite.root), "t"));
}

TEST(SiteBook, MistakesChangeNothing) {
  const auto list = enrol(begun(), {"alfa", Role::kStation, kSite.alfa.public_key()});
  EXPECT_THROW(enrol(list, {"bravo", Role::kStation, kSite.alfa.public_key()}),
               std::invalid_argument);
  EXPECT_THROW(enrol(list, {"alfa", Role::kOperator, kSite.bravo.public_key()}),
               std::invalid_argument);
  EXPECT_THROW(enrol(list, {"a b", Role::kStation, kSite.bravo.public_key()}),
               std::invalid_argument);
  EXPECT_THROW(revoke(list, "nobody"), std::invalid_argument);
  EXPECT_THROW(new_list("", kSite.root.public_key()), std::invalid_argument);
}

TEST(SiteBook, IsShownWithTheWordsOfEachKey) {
  const auto list =
      revoke(enrol(begun(), {"alfa", Role::kStation, kSite.alfa.public_key()}), "alfa");
  const std::string text = describe(list);
  EXPECT_THAT(text, HasSubstr("site airfield, list 3"));
  EXPECT_THAT(text, HasSubstr("revoked  " + trust::spoken(kSite.alfa.public_key())));
}

}  // namespace
}  // namespace ols::key
