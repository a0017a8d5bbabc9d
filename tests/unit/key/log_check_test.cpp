#include "tools/key/log_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/trust/messages_trust.h"
#include "tests/unit/base/trust/site_fixture.h"

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

Message telling(const trust::TrustList& list) {
  const auto message = trust::to_message(sign_list(list, kSite.root), 1, list.number, kThen_us);
  Message bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return with_trailer(kSite.fusion, kSite.secret, "OLS_TRUST", bytes, 0);
}

TEST(LogCheck, CountsGoodAndBadByChannelAndReason) {
  LogCheck check({{1, kSite.list()}});
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

TEST(LogCheck, ARevocationHoldsFromWhereTheRecordingTellsIt) {
  trust::TrustList later = kSite.list(2);
  later.members[0].revoked = true;
  LogCheck check({{1, kSite.list()}, {2, later}});
  check.add("OLS_TRUST", telling(kSite.list(1)), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 1), kThen_us);
  EXPECT_EQ(check.bad(), 0U) << "it was good then";
  check.add("OLS_TRUST", telling(later), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 2), kThen_us);
  EXPECT_EQ(check.bad(), 1U);
}

TEST(LogCheck, AListThatIsNotAmongTheKnownOnesChangesNothing) {
  trust::TrustList forged = kSite.list(7);
  forged.members[0].revoked = true;
  LogCheck check({{1, kSite.list()}});
  check.add("OLS_TRUST", telling(forged), kThen_us);
  check.add("OLS_BEARING_alfa", bearing(kSite.alfa, 1), kThen_us);
  EXPECT_EQ(check.bad(), 0U);
}

}  // namespace
}  // namespace ols::key
