#include "base/trust/verifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/trust/messages_trust.h"
#include "ols_msg/ptu_command_t.hpp"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/on_the_bus.h"

namespace ols::trust {
namespace {

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;
constexpr std::int64_t kBoot = 4711, kSender = 99;
const Site kSite;

using Message = std::vector<std::uint8_t>;

// As station alfa hears it.
class VerifierTest : public testing::Test {
 protected:
  VerifierTest() { config_.station = "alfa", config_.boot_id = kBoot, config_.is_stop = is_stop; }

  Message sign(const SigningKey& key, const std::string& channel, const Message& content,
               std::int64_t audience = 0) const {
    return with_trailer(key, kSite.secret, channel, content, audience);
  }
  Message order(std::int64_t sequence, std::int64_t audience = kBoot,
                std::int64_t age_us = 0) const {
    return sign(kSite.anna, "OLS_PTU_alfa", payload(kNow_us - age_us, kSender, sequence), audience);
  }
  Message order_to(std::int8_t what, std::int64_t boot, std::int64_t sequence,
                   std::int64_t utime_us) const {
    ols_msg::ptu_command_t command{};
    command.utime = utime_us, command.boot_id = boot, command.sequence = sequence;
    command.command = what;
    return sign(kSite.anna, "OLS_PTU_alfa", encoded(command), kBoot);
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
  const auto other = sign(kSite.anna, "OLS_DESIGNATE_alfa", payload(kNow_us, 1, 1), 0);
  const auto unaddressed = judge("OLS_DESIGNATE_alfa", other);
  EXPECT_EQ(unaddressed.distrust, std::nullopt) << "the answer tells its sender the boot";
  EXPECT_FALSE(unaddressed.addressed);
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

TEST_F(VerifierTest, BesideFreshStatusesARecordedOneIsRefused) {
  config_.takes_stale_statuses = true;
  const auto status = [&](std::int64_t utime_us, std::int64_t boot, std::int64_t sequence,
                          double now_s) {
    const auto content = payload(utime_us, boot, sequence, "bravo");
    return judge("OLS_STATUS_bravo", sign(kSite.bravo, "OLS_STATUS_bravo", content), now_s)
        .distrust;
  };
  EXPECT_EQ(status(1000, 1, 1, 10.0), std::nullopt) << "nothing else is known of it";
  EXPECT_EQ(status(kNow_us, 2, 1, 11.0), std::nullopt);
  EXPECT_EQ(status(1000, 1, 2, 12.0), Distrust::kStale);
  EXPECT_EQ(status(1000, 2, 2, 15.9), Distrust::kStale);
  EXPECT_EQ(status(1000, 1, 2, 16.1), Distrust::kStale) << "of another boot";
  EXPECT_EQ(status(1000, 2, 2, 16.1), std::nullopt) << "its clock became wrong";
  EXPECT_EQ(status(1000, 1, 2, 31.1), std::nullopt) << "its host booted anew";
  EXPECT_EQ(status(1000, 1, 2, 31.2), Distrust::kReplayed);
}

TEST_F(VerifierTest, NothingIsBelievedTwice) {
  EXPECT_EQ(of_bearing(bearing(5)), std::nullopt);
  EXPECT_EQ(of_bearing(bearing(5)), Distrust::kReplayed);
  EXPECT_EQ(of_bearing(bearing(4)), std::nullopt) << "overtaken";
  EXPECT_EQ(of_order(order(1)), std::nullopt);
  EXPECT_EQ(of_order(order(1)), Distrust::kReplayed);
}

// Each run of ols-ctl is a boot of its own; the last one's host has its clock 5 s behind.
TEST_F(VerifierTest, AStopOfAnUnknownBootIsTakenHoweverManyBootsCameBefore) {
  const auto run = [&](std::int64_t boot, std::int8_t what, std::int64_t utime_us) {
    return of_order(order_to(what, boot, 1, utime_us));
  };
  using Ptu = ols_msg::ptu_command_t;
  for (std::int64_t boot = 1; boot <= 40; ++boot) {
    EXPECT_EQ(run(boot, boot % 2 == 0 ? Ptu::COMMAND_STOP : Ptu::COMMAND_RELEASE, kNow_us + boot),
              std::nullopt);
  }
  EXPECT_EQ(run(50, Ptu::COMMAND_STOP, kNow_us - 5'000'000), std::nullopt);
  EXPECT_EQ(run(50, Ptu::COMMAND_STOP, kNow_us - 5'000'000), Distrust::kReplayed) << "once";
  EXPECT_EQ(run(1, Ptu::COMMAND_RELEASE, kNow_us + 1), Distrust::kReplayed) << "what moves, never";
  EXPECT_EQ(run(51, Ptu::COMMAND_STOP, kNow_us - 60'000'000), Distrust::kReplayed) << "recorded";
}

TEST_F(VerifierTest, AStationWithAWrongClockIsSeenHoweverManyBootsCameBefore) {
  config_.station.clear();
  config_.takes_stale_statuses = true;
  double now_s = 0.0;
  const auto boots = [&](std::int64_t boot, std::int64_t utime_us) {
    now_s += 60.0;
    const auto status = sign(kSite.alfa, "OLS_STATUS_alfa", payload(utime_us, boot, 1, "alfa"));
    return judge("OLS_STATUS_alfa", status, now_s).distrust;
  };
  EXPECT_EQ(boots(1, kNow_us + 1'000'000'000'000), std::nullopt) << "far ahead";
  for (std::int64_t boot = 2; boot <= 40; ++boot) {
    EXPECT_EQ(boots(boot, kNow_us + boot), std::nullopt);
  }
  EXPECT_EQ(boots(50, kNow_us - 1'000'000'000'000), std::nullopt) << "in the past";
  EXPECT_EQ(boots(50, kNow_us - 1'000'000'000'000), Distrust::kReplayed) << "once";
  EXPECT_EQ(boots(1, kNow_us + 1), Distrust::kReplayed) << "fresh ones must be later";
}

TEST_F(VerifierTest, OneMadMemberIsHeldByItsOwnRateAlone) {
  int passed = 0;
  for (std::int64_t i = 1; i <= 1000; ++i) passed += of_order(order(i)) ? 0 : 1;
  EXPECT_EQ(passed, 50) << "towards one station";
  EXPECT_EQ(of_order(order(1001)), Distrust::kRate);
  EXPECT_EQ(of_bearing(bearing(1)), std::nullopt) << "the others are heard";
  EXPECT_EQ(judge("OLS_DESIGNATE_alfa",
                  sign(kSite.anna, "OLS_DESIGNATE_alfa", payload(kNow_us, kSender, 1), kBoot))
                .distrust,
            std::nullopt);
  EXPECT_EQ(judge("OLS_PTU_alfa", order(1002), 11.0).distrust, std::nullopt) << "a second later";
}

TEST_F(VerifierTest, AFloodOfOrdersDoesNotKeepFromStopping) {
  for (std::int64_t i = 1; i <= 51; ++i) of_order(order(i));
  EXPECT_EQ(of_order(order(52)), Distrust::kRate);
  int stopped = 0;
  for (std::int64_t i = 100; i < 1100; ++i) {
    const auto stop = order_to(ols_msg::ptu_command_t::COMMAND_STOP, kSender, i, kNow_us);
    stopped += of_order(stop) ? 0 : 1;
  }
  EXPECT_EQ(stopped, 500) << "which have a limit too";
}

TEST_F(VerifierTest, AMadFusionIsHeldTowardsOneStationAndTheOthersAreSlewed) {
  const auto slew = [&](const std::string& channel, std::int64_t sequence) {
    const auto content = payload(kNow_us, kSender, sequence);
    return judge(channel, sign(kSite.fusion, channel, content, kBoot)).distrust;
  };
  int passed = 0;
  for (std::int64_t i = 1; i <= 300; ++i) passed += slew("OLS_SLEW_alfa", i) ? 0 : 1;
  EXPECT_EQ(passed, 120);
  EXPECT_EQ(slew("OLS_SLEW_alfa", 301), Distrust::kRate);
  EXPECT_EQ(slew("OLS_SLEW_bravo", 1), std::nullopt);
}

// As who records the whole site hears it.
TEST_F(VerifierTest, AllOrdersOfAMadOperatorTogetherHaveALimitToo) {
  TrustList list = kSite.list(2);
  for (int i = 0; i < 20; ++i) {
    list.members.push_back({"s" + std::to_string(i), Role::kStation,
                            SigningKey(seed_of(static_cast<std::uint8_t>(100 + i))).public_key()});
  }
  verifier().adopt(list);
  int passed = 0;
  for (std::int64_t i = 0; i < 500; ++i) {
    const std::string channel = "OLS_PTU_s" + std::to_string(i % 20);
    passed +=
        judge(channel, sign(kSite.anna, channel, payload(kNow_us, kSender, i), 1)).distrust ? 0 : 1;
  }
  EXPECT_EQ(passed, 200);
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
  for (std::int64_t i = 1; i <= 51; ++i) of_order(order(i));
  verifier().adopt(kSite.list(2));
  EXPECT_EQ(of_order(order(52)), Distrust::kRate);
}

TEST_F(VerifierTest, EachReasonHasAWord) {
  for (int i = 0; i < static_cast<int>(Distrust::kCount); ++i) {
    EXPECT_NE(std::string(to_string(static_cast<Distrust>(i))), "");
  }
}

}  // namespace
}  // namespace ols::trust
