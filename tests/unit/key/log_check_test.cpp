#include "tools/key/log_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/trust/messages_trust.h"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/on_the_bus.h"

namespace ols::key {
namespace {

using testing::HasSubstr;
using Message = std::vector<std::uint8_t>;

constexpr std::int64_t kThen_us = 1'600'000'000'000'000;
const trust::Site kSite;

Message bearing(const trust::SigningKey& key, std::int64_t sequence) {
  return with_trailer(key, kSite.secret, "OLS_BEARING_alfa",
                      trust::payload(kThen_us, 1, sequence, "alfa"), 0);
}

Message telling(const trust::TrustList& list, const trust::SigningKey& key = kSite.fusion) {
  const auto message = trust::to_message(sign_list(list, kSite.root), 1, list.number, kThen_us);
  return with_trailer(key, kSite.secret, "OLS_TRUST", encoded(message), 0);
}

TEST(LogCheck, CountsGoodAndBadByChannelAndReason) {
  LogCheck check({{1, kSite.list()}}, 1);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 1), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 2), kThen_us);
  EXPECT_EQ(check.bad(), 0U);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 2), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.bravo, 3), kThen_us);
  check.add("OLS_BEARING_alfa", trust::payload(kThen_us, 1, 4, "alfa"), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 5), kThen_us + 3'600'000'000);
  check.add("LCM_SELF_TEST", {}, kThen_us);
  EXPECT_EQ(check.bad(), 4U);
  EXPECT_THAT(check.text(), HasSubstr("2 good, 1 channel, 1 replayed, 1 stale, 1 unsigned"));
}

trust::TrustList without_alfa(std::int64_t number) {
  trust::TrustList list = kSite.list(number);
  list.members[0].revoked = true;
  return list;
}

TEST(LogCheck, ARevocationHoldsFromWhereTheRecordingTellsIt) {
  LogCheck check({{1, kSite.list()}, {2, without_alfa(2)}}, 1);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 1), kThen_us);
  check.add("OLS_TRUST", telling(kSite.list(1)), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 2), kThen_us);
  EXPECT_EQ(check.bad(), 0U) << "it was good then, before the first telling too";
  check.add("OLS_TRUST", telling(without_alfa(2)), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 3), kThen_us);
  EXPECT_EQ(check.bad(), 1U);
  EXPECT_THAT(check.in_force(), testing::ElementsAre(1, 2));
}

TEST(LogCheck, ARevokedKeyDoesNotComeBackByAnOlderList) {
  LogCheck check({{3, kSite.list(3)}, {4, without_alfa(4)}}, 4);
  check.add("OLS_TRUST", telling(without_alfa(4)), kThen_us);
  check.add("OLS_TRUST", telling(kSite.list(3), kSite.alfa), kThen_us);
  check.add("OLS_TRUST", telling(kSite.list(3)), kThen_us);
  for (std::int64_t i = 0; i < 30; ++i) {
    check.add("OLS_BEARING_alfa", bearing(kSite.alfa, i), kThen_us);
  }
  EXPECT_THAT(check.text(), HasSubstr("0 good, 30 revoked"));
  EXPECT_THAT(check.in_force(), testing::ElementsAre(4));
}

TEST(LogCheck, AListThatAStrangerTellsDoesNotCount) {
  LogCheck check({{1, kSite.list()}, {2, without_alfa(2)}}, 1);
  check.add("OLS_TRUST", telling(without_alfa(2), kSite.stranger), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 1), kThen_us);
  EXPECT_EQ(check.bad(), 1U) << "the telling alone";
}

// The fusion tells its own exchange with its new key, which the list before does not know.
TEST(LogCheck, AListIsFollowedThatAMemberOfItTells) {
  trust::TrustList later = kSite.list(2);
  later.members[2].revoked = true;
  later.members.push_back({"fusion", trust::Role::kFusion, kSite.stranger.public_key()});
  LogCheck check({{1, kSite.list()}, {2, later}}, 1);
  check.add("OLS_TRUST", telling(kSite.list()), kThen_us);
  check.add("OLS_TRUST", telling(later, kSite.stranger), kThen_us);
  EXPECT_EQ(check.bad(), 0U);
  EXPECT_THAT(check.in_force(), testing::ElementsAre(1, 2));
}

TEST(LogCheck, TheFirstListIsThatOfAMemberWhoIsNoStation) {
  const Lists lists{{3, kSite.list(3)}, {4, without_alfa(4)}};
  EXPECT_EQ(told_number(lists, "OLS_TRUST", telling(kSite.list(3))), 3);
  EXPECT_EQ(told_number(lists, "OLS_TRUST", telling(without_alfa(4))), 4);
  EXPECT_FALSE(told_number(lists, "OLS_TRUST", telling(kSite.list(3), kSite.alfa)));
  EXPECT_FALSE(told_number(lists, "OLS_TRUST", telling(without_alfa(4), kSite.stranger)));
  EXPECT_FALSE(told_number(lists, "OLS_TRUST", telling(kSite.list(5)))) << "not known";
  EXPECT_FALSE(told_number(lists, "OLS_BEARING_alfa", bearing(kSite.alfa, 1)));
}

TEST(LogCheck, AListThatIsNotAmongTheKnownOnesChangesNothing) {
  trust::TrustList forged = kSite.list(7);
  forged.members[0].revoked = true;
  LogCheck check({{1, kSite.list()}}, 1);
  check.add("OLS_TRUST", telling(forged), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 1), kThen_us);
  EXPECT_EQ(check.bad(), 0U);
}

}  // namespace
}  // namespace ols::key
