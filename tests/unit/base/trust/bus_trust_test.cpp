#include "base/trust/bus_trust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/config/toml_config.h"
#include "base/files/atomic_file.h"
#include "base/trust/messages_trust.h"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/eventually.h"
#include "tests/unit/folder_test.h"
#include "tests/unit/on_the_bus.h"

namespace ols::trust {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;
const Site kSite;

// Station alfa and the fusion, with their files.
class BusTrustTest : public FolderTest<> {
 protected:
  BusTrustTest() {
    std::filesystem::create_directories(folder_ + "/state");
    write_key("alfa", 2);
    write_key("fusion", 4);
    write_list(kSite.list());
  }

  void write_key(const std::string& name, std::uint8_t seed) const {
    write_member_key(folder_ + "/" + name + ".key",
                     {name, seed_of(seed), kSite.secret, kSite.root.public_key()});
  }
  void write_list(const TrustList& list) const {
    AtomicFile file(folder_ + "/trust.toml");
    file.stream() << sign_list(list, kSite.root);
    file.commit();
  }
  std::shared_ptr<BusTrust> open(Self self, const std::string& mode = "require") const {
    return BusTrust::open({}, {mode, folder_, "", folder_ + "/state"}, self);
  }
  std::shared_ptr<BusTrust> alfa() const {
    return open({.name = "alfa", .boot_id = 11, .is_station = true});
  }
  std::shared_ptr<BusTrust> fusion() const {
    return open({.name = "fusion", .boot_id = 12, .tells_list = true, .keeps_marks = true});
  }
  static Judgement hear(BusTrust& trust, const std::string& channel,
                        const std::vector<std::uint8_t>& m) {
    return trust.judge(channel, m, kNow_us, 5.0);
  }

  // `teller` passes the list on to `hearer`.
  static void tell(BusTrust& hearer, BusTrust& teller, const std::string& list,
                   std::int64_t sequence) {
    const auto message = to_message(list, 12, sequence, kNow_us);
    EXPECT_TRUE(hear(hearer, "OLS_TRUST", teller.sign("OLS_TRUST", encoded(message))).passes);
  }

  // By who has the site's secret.
  static std::vector<std::uint8_t> told_by_stranger(const TrustList& list, const SigningKey& root) {
    const auto message = to_message(sign_list(list, root), 12, 1, kNow_us);
    return with_trailer(kSite.stranger, kSite.secret, "OLS_TRUST", encoded(message), 0);
  }
};

TEST_F(BusTrustTest, OffIsNothingAndAWrongModeIsAnError) {
  EXPECT_EQ(open({.name = "nobody"}, ""), nullptr);
  EXPECT_EQ(open({.name = "nobody"}, "off"), nullptr);
  EXPECT_THROW(open({.name = "alfa"}, "maybe"), ConfigError);
  EXPECT_THROW(open({.name = "nobody"}), ConfigError) << "no key";
  TrustConfig others;
  others.key = folder_ + "/fusion.key";
  EXPECT_THROW(BusTrust::open(others, {"require", folder_, "", ""},
                              {.name = "alfa", .boot_id = 1, .is_station = true}),
               ConfigError)
      << "the key of another";
}

TEST_F(BusTrustTest, ASlewNamesTheBootThatTheStationsStatusSays) {
  const auto station = alfa(), centre = fusion();
  const auto early = centre->sign("OLS_SLEW_alfa", payload(kNow_us, 12, 1));
  EXPECT_EQ(hear(*station, "OLS_SLEW_alfa", early).distrust, Distrust::kOtherBoot);
  const auto status = station->sign("OLS_STATUS_alfa", payload(kNow_us, 11, 1, "alfa"));
  EXPECT_TRUE(hear(*centre, "OLS_STATUS_alfa", status).passes);
  const auto slew = centre->sign("OLS_SLEW_alfa", payload(kNow_us, 12, 2));
  const Judgement judged = hear(*station, "OLS_SLEW_alfa", slew);
  EXPECT_TRUE(judged.passes);
  EXPECT_TRUE(judged.addressed);
  EXPECT_EQ(judged.payload.size(), slew.size() - kTrailerBytes);
}

TEST_F(BusTrustTest, WhatNobodyAsksForIsNotVerifiedUnlessItTeachesSomething) {
  const auto station = alfa(), centre = fusion();
  EXPECT_TRUE(station->wants("OLS_TRUST"));
  EXPECT_FALSE(station->wants("OLS_STATUS_bravo"));
  EXPECT_FALSE(station->wants("OLS_BEARING_bravo"));
  EXPECT_TRUE(centre->wants("OLS_STATUS_bravo"));
  EXPECT_FALSE(centre->wants("OLS_BEARING_bravo"));
}

TEST_F(BusTrustTest, TellsEachListThatItTakes) {
  std::vector<std::int64_t> taken;
  const auto station = open(
      {.name = "alfa", .boot_id = 11, .is_station = true, .list_taken = [&](const TrustList& list) {
         taken.push_back(list.number);
       }});
  const auto centre = fusion();
  tell(*station, *centre, sign_list(kSite.list(2), kSite.root), 1);
  tell(*station, *centre, sign_list(kSite.list(2), kSite.root), 2);
  EXPECT_EQ(taken, (std::vector<std::int64_t>{1, 2}));
}

TEST_F(BusTrustTest, SaysByWhichListAMessageWasJudged) {
  const auto station = alfa(), centre = fusion();
  const std::vector<std::uint8_t> order = payload(kNow_us, 1, 1);
  EXPECT_EQ(hear(*station, "OLS_PTU_alfa", order).list_number, 1);
  tell(*station, *centre, sign_list(kSite.list(2), kSite.root), 1);
  EXPECT_EQ(hear(*station, "OLS_PTU_alfa", order).list_number, 2);
}

TEST_F(BusTrustTest, ObserveCountsAndLetsPass) {
  const auto watching = open({.name = "alfa", .boot_id = 11, .is_station = true}, "observe");
  const Judgement judged = hear(*watching, "OLS_PTU_alfa", payload(kNow_us, 1, 1));
  EXPECT_EQ(judged.distrust, Distrust::kUnsigned);
  EXPECT_TRUE(judged.passes);
  EXPECT_TRUE(judged.addressed);
  const auto requiring = alfa();
  EXPECT_FALSE(hear(*requiring, "OLS_PTU_alfa", payload(kNow_us, 1, 1)).passes);
}

TEST_F(BusTrustTest, AListThatIsToldReplacesALowerOneAndOutlastsARestart) {
  TrustList second = kSite.list(2);
  second.members[0].revoked = true;  // alfa itself
  {
    const auto station = alfa(), centre = fusion();
    EXPECT_EQ(station->trouble(), "");
    write_list(second);
    EXPECT_TRUE(eventually([&] { return centre->list_number() == 2; })) << "its file is watched";
    const auto told = centre->list_to_tell(100.0);
    ASSERT_TRUE(told);
    EXPECT_FALSE(centre->list_to_tell(101.0)) << "told just now";
    write_list(kSite.list(1));
    tell(*station, *centre, *told, 1);
    EXPECT_EQ(station->list_number(), 2);
    tell(*station, *centre, sign_list(kSite.list(1), kSite.root), 2);
    EXPECT_EQ(station->list_number(), 2) << "a lower one never replaces a higher one";
    EXPECT_THAT(station->trouble(), HasSubstr("revoked"));
    const auto bearing = station->sign("OLS_BEARING_alfa", payload(kNow_us, 11, 1, "alfa"));
    EXPECT_EQ(hear(*centre, "OLS_BEARING_alfa", bearing).distrust, Distrust::kRevoked);
    tell(*station, *centre, sign_list(kSite.list(9), kSite.stranger), 3);
    EXPECT_EQ(station->list_number(), 2) << "nor one of another root";
  }
  EXPECT_EQ(alfa()->list_number(), 2) << "though the file in its place is older";
}

TEST_F(BusTrustTest, WhatTheFusionHasHeardOutlastsARestart) {
  const auto station = alfa();
  const auto bearing = station->sign("OLS_BEARING_alfa", payload(kNow_us, 11, 1, "alfa"));
  EXPECT_TRUE(hear(*fusion(), "OLS_BEARING_alfa", bearing).passes);
  EXPECT_EQ(hear(*fusion(), "OLS_BEARING_alfa", bearing).distrust, Distrust::kReplayed);
}

TEST_F(BusTrustTest, AListInItsPlaceThatIsNoneIsSaidAndTheOldOneStands) {
  const auto centre = fusion();
  std::ofstream(folder_ + "/trust.toml") << "nonsense\n";
  EXPECT_TRUE(eventually([&] { return !centre->trouble().empty(); }));
  EXPECT_THAT(centre->trouble(), HasSubstr("trust.toml"));
  EXPECT_EQ(centre->list_number(), 1);
  write_list(kSite.list(3));
  EXPECT_TRUE(eventually([&] { return centre->list_number() == 3 && centre->trouble().empty(); }));
}

TEST_F(BusTrustTest, ANewMemberLearnsItsFirstListFromTheBus) {
  const auto centre = fusion();
  const std::string list = sign_list(kSite.list(3), kSite.root);
  std::filesystem::remove(folder_ + "/trust.toml");
  {
    const auto station = alfa();
    EXPECT_EQ(station->list_number(), 0);
    EXPECT_THAT(station->trouble(), HasSubstr("no trust list yet"));
    const auto slew = centre->sign("OLS_SLEW_alfa", payload(kNow_us, 12, 1));
    EXPECT_EQ(hear(*station, "OLS_SLEW_alfa", slew).distrust, Distrust::kStranger)
        << "it knows nobody yet";
    tell(*station, *centre, list, 1);
    EXPECT_EQ(station->list_number(), 3);
    EXPECT_EQ(station->trouble(), "");
  }
  EXPECT_EQ(alfa()->list_number(), 3) << "and keeps it";
}

TEST_F(BusTrustTest, NobodyButTheSiteTellsANewMemberItsFirstList) {
  std::filesystem::remove(folder_ + "/trust.toml");
  const auto station = alfa();
  const auto bytes = encoded(to_message(sign_list(kSite.list(3), kSite.root), 12, 1, kNow_us));
  const auto other_site = with_trailer(kSite.fusion, seed_of(8), "OLS_TRUST", bytes, 0);
  EXPECT_FALSE(hear(*station, "OLS_TRUST", other_site).passes) << "without the site's secret";
  EXPECT_FALSE(hear(*station, "OLS_TRUST", bytes).passes) << "unsigned";
  const auto elsewhere = with_trailer(kSite.fusion, kSite.secret, "OLS_STATUS_a", bytes, 0);
  EXPECT_FALSE(hear(*station, "OLS_TRUST", elsewhere).passes) << "of another channel";
  EXPECT_EQ(station->list_number(), 0);
}

// The centre was rebuilt while alfa was off.
TEST_F(BusTrustTest, AListIsTakenFromAFusionWhoseKeyOnlyTheListMakesKnown) {
  TrustList second = kSite.list(2);
  second.members[2].revoked = true;
  second.members.push_back({"fusion", Role::kFusion, kSite.stranger.public_key()});
  const auto station = alfa();
  const auto status =
      with_trailer(kSite.stranger, kSite.secret, "OLS_FUSION_STATUS", payload(kNow_us, 12, 1), 0);
  EXPECT_EQ(hear(*station, "OLS_FUSION_STATUS", status).distrust, Distrust::kStranger);
  EXPECT_TRUE(hear(*station, "OLS_TRUST", told_by_stranger(second, kSite.root)).passes);
  EXPECT_EQ(station->list_number(), 2);
  EXPECT_TRUE(hear(*station, "OLS_FUSION_STATUS", status).passes);
}

// A thief of one tripod has the site's secret, and old lists.
TEST_F(BusTrustTest, ListsThatAStrangerTellsNeitherReplaceNewerOnesNorKeepFromTheMembers) {
  write_list(kSite.list(5));
  const auto station = alfa(), centre = fusion();
  EXPECT_FALSE(hear(*station, "OLS_TRUST", told_by_stranger(kSite.list(4), kSite.root)).passes);
  EXPECT_EQ(station->list_number(), 5);
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(
        hear(*station, "OLS_TRUST", told_by_stranger(kSite.list(9), kSite.stranger)).passes);
  }
  EXPECT_EQ(station->trouble(), "") << "no stranger raises an alarm about the list";
  EXPECT_FALSE(hear(*station, "OLS_TRUST", told_by_stranger(kSite.list(6), kSite.root)).passes);
  EXPECT_EQ(station->list_number(), 5) << "too many of strangers within a second";
  tell(*station, *centre, sign_list(kSite.list(7), kSite.root), 1);
  EXPECT_EQ(station->list_number(), 7) << "a member is heard meanwhile";
}

// A centre that was restored from an old backup believes whom the others do not believe any more.
TEST_F(BusTrustTest, AMemberAnswersAnOlderListOfAnotherWithItsOwn) {
  write_list(kSite.list(5));
  const auto station = alfa(), centre = fusion();
  EXPECT_FALSE(station->list_to_tell(1.0)) << "it does not pass lists on";
  hear(*station, "OLS_TRUST", told_by_stranger(kSite.list(4), kSite.root));
  tell(*station, *centre, sign_list(kSite.list(5), kSite.root), 1);
  EXPECT_FALSE(station->list_to_tell(2.0)) << "neither a stranger's nor its own is answered";
  tell(*station, *centre, sign_list(kSite.list(4), kSite.root), 2);
  EXPECT_EQ(station->list_to_tell(3.0), sign_list(kSite.list(5), kSite.root));
  EXPECT_FALSE(station->list_to_tell(9.0)) << "once";
  tell(*station, *centre, sign_list(kSite.list(3), kSite.root), 3);
  tell(*station, *centre, sign_list(kSite.list(6), kSite.root), 4);
  EXPECT_EQ(station->list_number(), 6);
}

TEST_F(BusTrustTest, TheListOfAMemberIsTheHeadOfALog) {
  const auto station = alfa(), centre = fusion();
  const auto telling = centre->list_telling(kNow_us);
  ASSERT_TRUE(telling);
  EXPECT_TRUE(hear(*station, "OLS_TRUST", *telling).passes);
  EXPECT_EQ(list_from(without_trailer(*telling)), sign_list(kSite.list(), kSite.root));
  write_key("charlie", 6);
  EXPECT_FALSE(open({.name = "charlie"})->list_telling(kNow_us)) << "no member";
}

TEST_F(BusTrustTest, MarksThatCannotBeReadOrWrittenAreSaidUntilTheyCan) {
  std::filesystem::create_directories(folder_ + "/state/heard-fusion");
  const auto centre = fusion(), station = alfa();
  EXPECT_THAT(centre->trouble(), HasSubstr("received before this start is lost"));
  EXPECT_EQ(station->trouble(), "") << "it keeps none";
  const auto bearing = station->sign("OLS_BEARING_alfa", payload(kNow_us, 11, 1, "alfa"));
  EXPECT_TRUE(hear(*centre, "OLS_BEARING_alfa", bearing).passes);
  // Not by what a look at the list finds.
  EXPECT_TRUE(eventually([&] {
    return centre->trouble().text.find("cannot be kept for the next start") != std::string::npos;
  }));
}

TEST_F(BusTrustTest, SettingsThatTheCentreTellsAreTakenByAStation) {
  const auto station = alfa(), centre = fusion();
  SiteSettings head;
  head.site = "airfield";
  head.number = 7;
  const std::string signed_text = sign_settings(head, "geoid = \"g\"\n", "wanted", kSite.root);
  AtomicFile file(folder_ + "/site.toml");
  file.stream() << signed_text;
  file.commit();
  std::optional<std::string> told;
  EXPECT_TRUE(eventually([&] { return (told = centre->settings_to_tell(100.0)).has_value(); }));
  EXPECT_FALSE(station->settings_to_tell(100.0)) << "a station tells nobody";
  const auto bytes = encoded(to_settings_message(*told, 12, 1, kNow_us));
  EXPECT_FALSE(hear(*station, "OLS_SITE", bytes).passes) << "unsigned";
  EXPECT_TRUE(hear(*station, "OLS_SITE", centre->sign("OLS_SITE", bytes)).passes);
  EXPECT_EQ(station->site_settings_number(), 7);
}

TEST_F(BusTrustTest, SettingsAreThereAtTheStartOfWhoHasAKey) {
  SiteSettings head;
  head.site = "airfield";
  head.number = 2;
  std::ofstream(folder_ + "/site.toml") << sign_settings(head, "", "wanted", kSite.root);
  const Environment all{"require", folder_, "", folder_ + "/state"};
  EXPECT_EQ(settings_at_start({}, all, "alfa", {}).number, 2);
  EXPECT_EQ(settings_at_start({}, all, "nobody", {}).number, 0) << "no key";
  EXPECT_EQ(settings_at_start({}, {"off", folder_, "", ""}, "alfa", {}).number, 0);
}

TEST_F(BusTrustTest, AListThatTheConfigurationNamesMustBeThere) {
  TrustConfig config;
  config.list = folder_ + "/elsewhere.toml";
  EXPECT_THROW(BusTrust::open(config, {"require", folder_, "", ""},
                              {.name = "alfa", .boot_id = 1, .is_station = true}),
               ConfigError);
}

TEST_F(BusTrustTest, AKeyThatIsNotEnrolledIsSaid) {
  write_key("charlie", 6);
  EXPECT_THAT(open({.name = "charlie"})->trouble(), HasSubstr("is not in trust list 1"));
}

TEST(ProcessEnvironment, OfTheFoldersThatSystemdNamesTheFirstIsTheState) {
  ::setenv("STATE_DIRECTORY", "/var/lib/ols:/var/lib/ols/exports", 1);
  EXPECT_EQ(process_environment().state, "/var/lib/ols");
  ::unsetenv("STATE_DIRECTORY");
  EXPECT_EQ(process_environment().state, "");
}

}  // namespace
}  // namespace ols::trust
