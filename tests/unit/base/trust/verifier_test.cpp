#include "base/trust/verifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/base/trust/site_fixture.h"

namespace ols::trust {
namespace {

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;
constexpr std::int64_t kBoot = 4711, kSender = 99;
const Site kSite;

using Message = std::vector<std::uint8_t>;

// As station alfa hears it.
class VerifierTest : public testing::Test {
 protected:
  VerifierTest() { config_.station = "alfa", config_.boot_id = kBoot; }

  Message sign(const SigningKey& key, const std::string& channel, const Message& content,
               std::int64_t audience = 0) const {
    return with_trailer(key, kSite.secret, channel, content, audience);
  }
  Message order(std::int64_t sequence, std::int64_t audience = kBoot,
                std::int64_t age_us = 0) const {
    return sign(kSite.anna, "OLS_PTU_alfa", payload(kNow_us - age_us, kSender, sequence), audience);
  }
  Message bearing(std::int64_t sequence, const SigningKey& key = kSite.bravo) const {
    return sign(key, "OLS_BEARING_bravo", payload(kNow_us, kSender, sequence, "bravo"));
  }
  // A bearing in bravo's name, signed by alfa's stolen key; the site's secret is stolen too.
  Message forged_by_thief(std::int64_t sequence) const {
    Message forged = bearing(sequence, kSite.alfa);
    const KeyId bravo = key_id(kSite.bravo.public_key());
    const auto content = payload(kNow_us, kSender, sequence, "bravo");
    auto text = signed_text("OLS_BEARING_bravo", content, bravo, 0);
    const Signature signature = kSite.alfa.sign(text);
    text.insert(text.end(), signature.begin(), signature.end());
    const SiteTag tag = site_tag(kSite.secret, text);
    const auto trailer = forged.end() - kTrailerBytes;
    std::ranges::copy(bravo, trailer);
    std::ranges::copy(tag, trailer + 16);
    std::ranges::copy(signature, trailer + 24);
    return forged;
  }
  Verifier::Verdict judge(const std::string& channel, const Message& message, double now_s = 10.0) {
    return verifier().judge(channel, message, {kNow_us, now_s});
  }
  std::optional<Distrust> of_order(const Message& message) {
    return judge("OLS_PTU_alfa", message).distrust;
  }
  std::optional<Distrust> of_bearing(const Message& message) {
    return judge("OLS_BEARING_bravo", message).distrust;
  }
  Verifier& verifier() {
    if (!verifier_) verifier_.emplace(config_, kSite.secret, kSite.list());
    return *verifier_;
  }

  Verifier::Config config_;
  std::optional<Verifier> verifier_;
};

TEST_F(VerifierTest, BelievesAMemberOnItsOwnChannel) {
  const auto verdict = judge("OLS_BEARING_bravo", bearing(1));
  EXPECT_EQ(verdict.distrust, std::nullopt);
  EXPECT_EQ(verdict.sender, "bravo");
  EXPECT_EQ(verdict.head.sequence, 1);
  EXPECT_EQ(of_order(order(1)), std::nullopt);
}

TEST_F(VerifierTest, NoByteOfASignedMessageCanBeChanged) {
  const Message good = order(1);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const std::uint8_t bit : {0x01, 0x80}) {
      Message bad = good;
      bad[i] ^= bit;
      EXPECT_NE(of_order(bad), std::nullopt) << "byte " << i;
    }
  }
  EXPECT_EQ(of_order(good), std::nullopt) << "none of them counts as heard";
}

TEST_F(VerifierTest, WhatIsUnsignedOrOfAStrangerIsSaidSo) {
  EXPECT_EQ(of_bearing(payload(kNow_us, 1, 1, "bravo")), Distrust::kUnsigned);
  EXPECT_EQ(of_bearing({}), Distrust::kUnsigned);
  EXPECT_EQ(of_bearing(bearing(1, kSite.stranger)), Distrust::kStranger);
  // A member's key id, but not the site's secret: no signature is verified for it.
  const auto content = payload(kNow_us, kSender, 1, "bravo");
  EXPECT_EQ(of_bearing(with_trailer(kSite.bravo, seed_of(77), "OLS_BEARING_bravo", content, 0)),
            Distrust::kStranger);
}

// A thief of one tripod knows the site's secret, and one key.
TEST_F(VerifierTest, TheSitesSecretAloneIsNotEnough) {
  EXPECT_EQ(of_bearing(forged_by_thief(1)), Distrust::kSignature);
}

TEST_F(VerifierTest, AMessageIsGoodOnItsChannelOnly) {
  const Message good = bearing(1);
  EXPECT_EQ(judge("OLS_BEARING_alfa", good).distrust, Distrust::kStranger) << "the tag has it";
  EXPECT_EQ(judge("OLS_STATUS_bravo", good).distrust, Distrust::kStranger);
  const auto as_alfa = sign(kSite.bravo, "OLS_BEARING_alfa", payload(kNow_us, 1, 1, "alfa"));
  EXPECT_EQ(judge("OLS_BEARING_alfa", as_alfa).distrust, Distrust::kChannel);
  const auto inside = sign(kSite.bravo, "OLS_BEARING_bravo", payload(kNow_us, 1, 1, "alfa"));
  EXPECT_EQ(of_bearing(inside), Distrust::kChannel) << "another station's name inside";
  const auto order_of_fusion = sign(kSite.fusion, "OLS_PTU_alfa", payload(kNow_us, 1, 1), kBoot);
  EXPECT_EQ(of_order(order_of_fusion), Distrust::kChannel);
  EXPECT_EQ(judge("CHAT", sign(kSite.anna, "CHAT", payload(kNow_us, 1, 1))).distrust,
            Distrust::kChannel);
  const auto nobody = sign(kSite.anna, "OLS_PTU_nobody", payload(kNow_us, 1, 1));
  EXPECT_EQ(judge("OLS_PTU_nobody", nobody).distrust, Distrust::kChannel) << "not enrolled";
}

TEST_F(VerifierTest, SignedNonsenseIsMalformed) {
  EXPECT_EQ(of_bearing(sign(kSite.bravo, "OLS_BEARING_bravo", {1, 2, 3})), Distrust::kMalformed);
}

TEST_F(VerifierTest, ACommandNamesThisBoot) {
  EXPECT_TRUE(judge("OLS_PTU_alfa", order(1)).addressed);
  EXPECT_EQ(of_order(order(2, kBoot + 1)), Distrust::kOtherBoot);
  const auto stop = judge("OLS_PTU_alfa", order(3, 0));
  EXPECT_EQ(stop.distrust, std::nullopt) << "it may be a stop";
  EXPECT_FALSE(stop.addressed);
  const auto slew = sign(kSite.fusion, "OLS_SLEW_alfa", payload(kNow_us, 1, 1), 0);
  EXPECT_EQ(judge("OLS_SLEW_alfa", slew).distrust, Distrust::kOtherBoot) << "it is no stop";
  const auto for_bravo = sign(kSite.anna, "OLS_PTU_bravo", payload(kNow_us, 1, 1), 5);
  EXPECT_EQ(judge("OLS_PTU_bravo", for_bravo).distrust, std::nullopt) << "bravo will judge";
}

TEST_F(VerifierTest, OnlyWhatNamesThisBootMayBeOfAnotherTime) {
  constexpr std::int64_t kHour_us = 3'600'000'000;
  EXPECT_EQ(of_order(order(1, kBoot, kHour_us)), std::nullopt) << "the station judges its lease";
  EXPECT_EQ(of_order(order(2, 0, kHour_us)), Distrust::kStale);
  EXPECT_EQ(of_order(order(3, 0, -kHour_us)), Distrust::kStale) << "of the future";
  for (const std::int64_t utime_us :
       {kNow_us - kHour_us, kNow_us + kHour_us, std::int64_t{0},
        std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    const auto old = sign(kSite.bravo, "OLS_BEARING_bravo", payload(utime_us, 1, 1, "bravo"));
    EXPECT_EQ(of_bearing(old), Distrust::kStale) << utime_us;
  }
}

TEST_F(VerifierTest, AStationWithAWrongClockIsSeenByWhoCommandsIt) {
  const auto status = sign(kSite.bravo, "OLS_STATUS_bravo", payload(1000, 1, 1, "bravo"));
  EXPECT_EQ(judge("OLS_STATUS_bravo", status).distrust, Distrust::kStale);
  config_.takes_stale_statuses = true;
  verifier_.reset();
  EXPECT_EQ(judge("OLS_STATUS_bravo", status).distrust, std::nullopt);
}

TEST_F(VerifierTest, NothingIsBelievedTwice) {
  EXPECT_EQ(of_bearing(bearing(5)), std::nullopt);
  EXPECT_EQ(of_bearing(bearing(5)), Distrust::kReplayed);
  EXPECT_EQ(of_bearing(bearing(4)), std::nullopt) << "overtaken";
  EXPECT_EQ(of_order(order(1)), std::nullopt);
  EXPECT_EQ(of_order(order(1)), Distrust::kReplayed);
}

TEST_F(VerifierTest, OneMadMemberIsHeldByItsOwnRateAlone) {
  int passed = 0;
  for (std::int64_t i = 1; i <= 1000; ++i) passed += of_order(order(i)) ? 0 : 1;
  EXPECT_EQ(passed, 200);
  EXPECT_EQ(of_order(order(1001)), Distrust::kRate);
  EXPECT_EQ(of_bearing(bearing(1)), std::nullopt) << "the others are heard";
  EXPECT_EQ(judge("OLS_DESIGNATE_alfa",
                  sign(kSite.anna, "OLS_DESIGNATE_alfa", payload(kNow_us, kSender, 1), kBoot))
                .distrust,
            std::nullopt);
  EXPECT_EQ(judge("OLS_PTU_alfa", order(1002), 11.0).distrust, std::nullopt) << "a second later";
}

TEST_F(VerifierTest, ForgeriesInAMembersNameDoNotUseUpItsRateOrItsSequences) {
  for (std::int64_t i = 1; i < 1000; ++i) {
    EXPECT_EQ(of_bearing(forged_by_thief(i)), Distrust::kSignature);
  }
  for (std::int64_t i = 1; i < 64; ++i) EXPECT_EQ(of_bearing(bearing(i)), std::nullopt);
}

TEST_F(VerifierTest, ARevokedKeyEndsAndTheOthersGoOn) {
  EXPECT_EQ(of_bearing(bearing(1)), std::nullopt);
  TrustList list = kSite.list(2);
  list.members[1].revoked = true;
  list.members.push_back({"charlie", Role::kStation, kSite.stranger.public_key()});
  verifier().adopt(list);
  EXPECT_EQ(of_bearing(bearing(2)), Distrust::kRevoked);
  EXPECT_EQ(of_order(order(1)), std::nullopt);
  const auto new_one =
      sign(kSite.stranger, "OLS_BEARING_charlie", payload(kNow_us, 1, 1, "charlie"));
  EXPECT_EQ(judge("OLS_BEARING_charlie", new_one).distrust, std::nullopt);
  EXPECT_EQ(of_order(order(1)), Distrust::kReplayed) << "marks outlast a new list";
}

TEST_F(VerifierTest, ANewListGivesAMadMemberNoNewBreath) {
  for (std::int64_t i = 1; i <= 201; ++i) of_order(order(i));
  verifier().adopt(kSite.list(2));
  EXPECT_EQ(of_order(order(202)), Distrust::kRate);
}

TEST_F(VerifierTest, EachReasonHasAWord) {
  for (int i = 0; i < static_cast<int>(Distrust::kCount); ++i) {
    EXPECT_NE(std::string(to_string(static_cast<Distrust>(i))), "");
  }
}

}  // namespace
}  // namespace ols::trust
