#include "bridge/passage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/trust/trailer.h"
#include "bridge/messages.h"
#include "bridge_messages.h"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/ptu_command_t.hpp"

namespace ols::bridge {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr Now kNow{kNow_us, 100.0};

PassageConfig site() {
  PassageConfig config;
  config.region = "r";
  config.site = "s";
  config.commands = {"slew"};
  config.takes = {parse_selection("r.border.*")};
  return config;
}

PassageConfig region() {
  PassageConfig config = site();
  config.role = Role::kRegion;
  config.takes = {parse_selection("r.*.*")};
  config.targets = true;
  return config;
}

std::uint64_t refused(const Counts& counts, Refusal why) {
  return counts.refused[static_cast<std::size_t>(why)];
}

TEST(Passage, AStationsMessagesGoOutUnderItsSubjectAndNumber) {
  Passage passage(site());
  const auto out = passage.out("OLS_BEARING_alfa", bearing("alfa", 5), kNow);
  ASSERT_TRUE(out);
  EXPECT_EQ(out->subject, "ols.v1.r.s.alfa.bearing");
  EXPECT_EQ(out->headers.at(kIdHeader), "alfa:7:5");
  ols_msg::station_status_t status{};
  status.station = "alfa";
  status.boot_id = 7;
  status.sequence = 5;
  const auto state = passage.out("OLS_STATUS_alfa", encoded(status), kNow);
  EXPECT_EQ(state->subject, "ols.v1.r.s.alfa.status");
  EXPECT_EQ(state->headers.at(kIdHeader), "alfa:7:5:status");
  EXPECT_EQ(passage.out_counts().passed, 2U);
}

TEST(Passage, ASignatureIsNoPartOfTheMessageAndDoesNotDisturb) {
  Passage passage(site());
  auto bytes = bearing("alfa");
  std::vector<std::uint8_t> trailer(trust::kTrailerBytes, 0);
  const std::vector<std::uint8_t> end{1, 0, 0, 0, 'O', 'L', 'S', 'T'};
  std::copy(end.begin(), end.end(), trailer.end() - static_cast<std::ptrdiff_t>(end.size()));
  bytes.insert(bytes.end(), trailer.begin(), trailer.end());
  EXPECT_TRUE(passage.out("OLS_BEARING_alfa", bytes, kNow));
}

TEST(Passage, WhatCameInNeverGoesOut) {
  Passage passage(site());
  EXPECT_EQ(passage.in("ols.v1.r.border.echo.bearing", {}, bearing("echo"), kNow),
            "OLS_BEARING_echo");
  EXPECT_FALSE(passage.out("OLS_BEARING_echo", bearing("echo"), kNow));
  EXPECT_EQ(refused(passage.out_counts(), Refusal::kOwn), 1U);
  EXPECT_EQ(passage.out_counts().last_refusal, "") << "the bus gives it back: that is normal";
}

TEST(Passage, WhatGoesOutNeverComesIn) {
  Passage passage(site());
  EXPECT_FALSE(passage.in("ols.v1.r.s.alfa.bearing", {}, bearing("alfa"), kNow));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kOwn), 1U);
}

TEST(Passage, ANameBelongsToOnePlaceUntilItIsSilent) {
  Passage passage(site());
  EXPECT_TRUE(passage.out("OLS_BEARING_alfa", bearing("alfa"), kNow));
  const auto come = [&](double later_s) {
    return passage.in("ols.v1.r.border.alfa.bearing", {}, bearing("alfa"),
                      {kNow_us, kNow.monotonic_s + later_s});
  };
  EXPECT_FALSE(come(1.0));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kName), 1U);
  EXPECT_THAT(passage.in_counts().last_refusal,
              HasSubstr("ols.v1.r.border.alfa.bearing: a station that another site already has"));
  EXPECT_TRUE(come(61.0));
}

TEST(Passage, OnlyWhatIsWantedComesIn) {
  Passage passage(site());
  EXPECT_FALSE(passage.in("ols.v1.r.other.x.bearing", {}, bearing("x"), kNow));
  EXPECT_FALSE(passage.in("ols.v1.r.target", {}, target(1), kNow));
  EXPECT_FALSE(passage.in("ols.v1.r.border.*.bearing", {}, bearing("*"), kNow));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kShape), 3U);
  PassageConfig some = site();
  some.stations = {"alfa"};
  Passage chosen(some);
  EXPECT_TRUE(chosen.out("OLS_BEARING_alfa", bearing("alfa"), kNow));
  EXPECT_FALSE(chosen.out("OLS_BEARING_bravo", bearing("bravo"), kNow));
}

TEST(Passage, AMessageNamesItsOwnStation) {
  Passage passage(site());
  EXPECT_FALSE(passage.out("OLS_BEARING_alfa", bearing("bravo"), kNow));
  EXPECT_EQ(refused(passage.out_counts(), Refusal::kName), 1U);
  EXPECT_FALSE(passage.in("ols.v1.r.border.echo.bearing", {}, bearing("alfa"), kNow));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kName), 1U);
}

TEST(Passage, SizeShapeAndRateAreLimited) {
  Passage passage(site());
  std::vector<std::uint8_t> large = bearing("alfa");
  large.resize(9000);
  EXPECT_FALSE(passage.out("OLS_BEARING_alfa", large, kNow));
  EXPECT_EQ(refused(passage.out_counts(), Refusal::kSize), 1U);
  EXPECT_FALSE(passage.out("OLS_BEARING_alfa", std::vector<std::uint8_t>(5), kNow));
  EXPECT_EQ(refused(passage.out_counts(), Refusal::kMalformed), 1U);
  EXPECT_FALSE(passage.out("OLS_PREVIEW_alfa", bearing("alfa"), kNow));
  int passed = 0;
  for (int i = 0; i < 2000; ++i)
    passed += passage.out("OLS_BEARING_bravo", bearing("bravo"), kNow) ? 1 : 0;
  EXPECT_EQ(passed, 400);
  EXPECT_TRUE(passage.out("OLS_BEARING_charlie", bearing("charlie"), kNow))
      << "each name has its own";
}

TEST(Passage, ACommandIsObeyedWhileItIsFresh) {
  Passage passage(site());
  const auto come = [&passage](double age_s) {
    return passage.in("ols.v1.r.s.alfa.cmd.slew", {}, slew("alfa", age_s), kNow);
  };
  EXPECT_EQ(come(0.5), "OLS_SLEW_alfa");
  EXPECT_FALSE(come(1.5));
  EXPECT_FALSE(come(60.0));
  EXPECT_FALSE(come(-2.0));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kStale), 3U);
  EXPECT_FALSE(passage.in("ols.v1.r.s.alfa.cmd.ptu", {}, slew("alfa"), kNow)) << "not configured";
  EXPECT_FALSE(passage.in("ols.v1.r.other.alfa.cmd.slew", {}, slew("alfa"), kNow));
}

TEST(Passage, WhatIsLiveComesInTimeOrNotAtAll) {
  Passage passage(region());
  const auto come = [&passage](double later_s, std::int64_t sequence) {
    const auto later_us = static_cast<std::int64_t>(later_s * 1e6);
    return passage.in("ols.v1.r.hill.alfa.bearing", {}, bearing("alfa", sequence),
                      {kNow_us + later_us, kNow.monotonic_s + later_s});
  };
  EXPECT_TRUE(come(4.9, 1));
  EXPECT_EQ(passage.late(104.9), "");
  EXPECT_FALSE(come(20.0, 2));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kStale), 1U);
  EXPECT_EQ(passage.late(120.0), "alfa, 20 s");
  EXPECT_EQ(passage.late(131.0), "");
  EXPECT_TRUE(come(-60.0, 3)) << "a clock that is ahead is the fusion's matter";
  EXPECT_EQ(passage.gaps().missing(), 0U) << "what is late is not missing";
  const Now late{kNow_us + 6'000'000, 106.0};
  EXPECT_TRUE(passage.hears_target("ols.v1.q.target", target(1), kNow));
  EXPECT_FALSE(passage.hears_target("ols.v1.q.target", target(1), late));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kStale), 2U);
  Passage out(site());
  EXPECT_TRUE(out.out("OLS_BEARING_alfa", bearing("alfa"), late)) << "the archive wants it";
}

TEST(Passage, AHostileStampDoesNotOverflow) {
  Passage passage(site());
  ols_msg::slew_t message{};
  for (const std::int64_t utime :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    message.utime = utime;
    EXPECT_FALSE(passage.in("ols.v1.r.s.alfa.cmd.slew", {}, encoded(message), kNow));
  }
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kStale), 2U);
}

TEST(Passage, ARegionsCommandGoesWhereTheStationIs) {
  Passage passage(region());
  EXPECT_FALSE(passage.out("OLS_SLEW_alfa", slew("alfa"), kNow));
  EXPECT_EQ(refused(passage.out_counts(), Refusal::kNobody), 1U);
  EXPECT_TRUE(passage.in("ols.v1.r.hill.alfa.bearing", {}, bearing("alfa"), kNow));
  const auto out = passage.out("OLS_SLEW_alfa", slew("alfa"), kNow);
  ASSERT_TRUE(out);
  EXPECT_EQ(out->subject, "ols.v1.r.hill.alfa.cmd.slew");
  EXPECT_EQ(out->headers.count(kIdHeader), 0U) << "a command is never stored";
  EXPECT_FALSE(passage.out("OLS_SLEW_alfa", slew("alfa", 3.0), kNow)) << "stale here already";
  EXPECT_FALSE(passage.out("OLS_BEARING_alfa", bearing("alfa"), kNow)) << "a site's";
  EXPECT_FALSE(passage.in("ols.v1.r.s.alfa.cmd.slew", {}, slew("alfa"), kNow)) << "a site's";
}

TEST(Passage, OnlyTheOwnersTargetsAndSlewsGoOut) {
  Passage passage(region());
  EXPECT_TRUE(passage.in("ols.v1.r.hill.alfa.bearing", {}, bearing("alfa"), kNow));
  const Owned owned = [](Kind, Bytes) { return Grant{"north-1", 6, true, "north=7"}; };
  const Owned other = [](Kind, Bytes) { return std::optional<Grant>(); };
  const auto out = passage.out("OLS_TARGET", target(3), kNow, owned);
  ASSERT_TRUE(out);
  EXPECT_EQ(out->subject, "ols.v1.r.target");
  EXPECT_EQ(out->headers.at(kTargetHeader), "north-1");
  EXPECT_EQ(out->headers.at(kEpochHeader), "6");
  EXPECT_EQ(out->headers.at(kOwnerHeader), "north=7");
  EXPECT_EQ(out->headers.at(kIdHeader), "target:9:12");
  EXPECT_EQ(out->headers.count(kUnconfirmedHeader), 0U);
  EXPECT_EQ(passage.out("OLS_SLEW_alfa", slew("alfa"), kNow, owned)->headers.at(kEpochHeader), "6");
  EXPECT_FALSE(passage.out("OLS_TARGET", target(3), kNow, other));
  EXPECT_FALSE(passage.out("OLS_SLEW_alfa", slew("alfa"), kNow, other));
  EXPECT_EQ(refused(passage.out_counts(), Refusal::kNotOwned), 2U);
  const Owned alone = [](Kind, Bytes) { return Grant{"north-1", 6, false}; };
  EXPECT_EQ(passage.out("OLS_TARGET", target(3), kNow, alone)->headers.at(kUnconfirmedHeader), "1");
}

TEST(Passage, WhereATargetIsHiddenGoesTheWayOfItsSlews) {
  PassageConfig config = region();
  config.commands = {"slew", "occlusion"};
  Passage passage(config);
  EXPECT_TRUE(passage.in("ols.v1.r.hill.alfa.bearing", {}, bearing("alfa"), kNow));
  ols_msg::occlusion_t occlusion{};
  occlusion.utime = kNow_us;
  occlusion.station = std::string("alfa");
  const auto bytes = encoded(occlusion);
  const Owned owned = [](Kind, Bytes) { return Grant{"north-1", 6, true, "north=7"}; };
  const auto out = passage.out("OLS_OCCLUSION_alfa", bytes, kNow, owned);
  ASSERT_TRUE(out) << passage.out_counts().last_refusal;
  EXPECT_EQ(out->subject, "ols.v1.r.hill.alfa.cmd.occlusion");
  EXPECT_EQ(out->headers.at(kEpochHeader), "6");
  const Owned other = [](Kind, Bytes) { return std::optional<Grant>(); };
  EXPECT_FALSE(passage.out("OLS_OCCLUSION_alfa", bytes, kNow, other));
}

TEST(Passage, WhatAnOperatorOrdersNeedsNoOwner) {
  PassageConfig config = region();
  config.commands = commands();
  Passage passage(config);
  Ownership ownership({"north=1"});
  const Owned owned = [&ownership](Kind kind, Bytes payload) -> std::optional<Grant> {
    const auto id = target_id_of(kind, payload);
    return id ? ownership.grant(*id, kNow) : std::nullopt;
  };
  EXPECT_TRUE(passage.in("ols.v1.r.hill.alfa.bearing", {}, bearing("alfa"), kNow));
  ols_msg::ptu_command_t stop{};
  stop.utime = kNow_us;
  stop.station = std::string("alfa");
  const auto out = passage.out("OLS_PTU_alfa", encoded(stop), kNow, owned);
  ASSERT_TRUE(out) << passage.out_counts().last_refusal;
  EXPECT_EQ(out->subject, "ols.v1.r.hill.alfa.cmd.ptu");
  EXPECT_EQ(out->headers.size(), 0U) << "it competes with no owner";
  EXPECT_FALSE(passage.out("OLS_SLEW_alfa", slew("alfa"), kNow, owned)) << "nobody's target yet";
}

TEST(Passage, WhatIsNoMessageTakesNoName) {
  Passage passage(region());
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::string("n").append(std::to_string(i));
    const std::string state = to_text({Kind::kStatus, "r", "hill", name, ""});
    EXPECT_FALSE(
        passage.in(to_text({Kind::kBearing, "r", "hill", name, ""}), {}, bearing("other"), kNow));
    const std::vector<std::uint8_t> rubbish(5);
    EXPECT_FALSE(passage.in(state, {}, rubbish, kNow));
    const std::vector<std::uint8_t> large(40'000);
    EXPECT_FALSE(passage.in(state, {}, large, kNow));
  }
  EXPECT_EQ(passage.stations(), 0U);
}

TEST(Passage, AnOwnersOlderTargetIsLedToAtOnce) {
  Passage passage(site());
  const auto come = [&passage](const char* target, const char* owner, const char* epoch) {
    const Headers headers{{kTargetHeader, target}, {kOwnerHeader, owner}, {kEpochHeader, epoch}};
    return passage.in("ols.v1.r.s.alfa.cmd.slew", headers, slew("alfa"), kNow).has_value();
  };
  EXPECT_TRUE(come("north=7-2", "north=7", "9"));
  EXPECT_FALSE(come("south=3-1", "south=3", "4"));
  EXPECT_TRUE(come("north=7-1", "north=7", "4"));
  EXPECT_FALSE(come("north=7-1", "no owner", "4"));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kMalformed), 1U);
}

TEST(Passage, HeadersThatNoBridgeWritesAreRefused) {
  Passage passage(site());
  const auto come = [&passage](const std::string& target, const std::string& epoch) {
    const Headers headers{{kTargetHeader, target}, {kEpochHeader, epoch}};
    return passage.in("ols.v1.r.s.alfa.cmd.slew", headers, slew("alfa"), kNow).has_value();
  };
  EXPECT_FALSE(come(std::string(60'000, 'x'), "5"));
  EXPECT_FALSE(come("a\tb", "5"));
  EXPECT_FALSE(come("north=1-1", "-5"));
  EXPECT_FALSE(come("north=1-1", "5 "));
  EXPECT_FALSE(come("north=1-1", "99999999999999999999999"));
  EXPECT_FALSE(come("north=1-1", ""));
  EXPECT_EQ(refused(passage.in_counts(), Refusal::kMalformed), 6U);
  EXPECT_FALSE(come("north=1-1", "18446744073709551615"));
  EXPECT_TRUE(come("north=1-1", "5")) << "what was refused is not remembered";
}

TEST(Passage, GapsOfWhatComesInAreWatched) {
  Passage passage(region());
  for (const int sequence : {1, 2, 5}) {
    passage.in("ols.v1.r.hill.alfa.bearing", {}, bearing("alfa", sequence), kNow);
  }
  EXPECT_EQ(passage.gaps().missing(), 2U);
  EXPECT_EQ(passage.sites_ago_s(kNow.monotonic_s + 2.0).at("hill"), 2.0);
}

TEST(Passage, SubscribesToWhatMayPassAndToNothingElse) {
  EXPECT_EQ(Passage(site()).channels(), "OLS_(BEARING|STATUS|REPLY|SKYLINE)_.*");
  EXPECT_THAT(
      Passage(site()).subjects(),
      ElementsAre("ols.v1.r.border.*.bearing", "ols.v1.r.border.*.status",
                  "ols.v1.r.border.*.reply", "ols.v1.r.border.*.skyline", "ols.v1.r.s.*.cmd.slew"));
  PassageConfig some = site();
  some.stations = {"alfa", "bravo"};
  some.takes.clear();
  EXPECT_EQ(Passage(some).channels(), "OLS_(BEARING|STATUS|REPLY|SKYLINE)_(alfa|bravo)");
  EXPECT_THAT(Passage(some).subjects(),
              ElementsAre("ols.v1.r.s.alfa.cmd.slew", "ols.v1.r.s.bravo.cmd.slew"));
  EXPECT_EQ(Passage(region()).channels(), "OLS_TARGET|OLS_SLEW_.*");
}

}  // namespace
}  // namespace ols::bridge
