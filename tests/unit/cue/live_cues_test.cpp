#include "cue/live_cues.h"

#include <gtest/gtest.h>

#include <limits>

#include "conditions/refusal.h"

namespace ols::cues {
namespace {

constexpr std::int64_t kNow_us = 1'795'428'930'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Report good(const std::string& name = "a") {
  Report report;
  report.name = name;
  report.utime_us = kNow_us;
  report.latitude_deg = 49.2;
  report.longitude_deg = 16.6;
  report.height_m = 400.0;
  return report;
}

LiveCues live_cues(int most = 8) {
  InputRules rules;
  rules.name = "tak";
  rules.area_deg = {49.0, 16.0, 90.0, 17.0};
  return LiveCues({rules}, most);
}

void expect_refused(const Report& report, const char* why, std::int64_t now_us = kNow_us) {
  LiveCues fresh = live_cues();
  fresh.take(0, {report}, now_us);
  EXPECT_TRUE(fresh.live(now_us).empty()) << why;
  EXPECT_EQ(fresh.counts()[0].refused.at(why), 1) << why;
  EXPECT_EQ(fresh.counts()[0].taken, 0);
  EXPECT_EQ(fresh.counts()[0].last_refusal, "a: " + refusal_words(why, "cue_"));
}

TEST(LiveCues, FillsInWhatASourceDoesNotSay) {
  LiveCues one = live_cues();
  Report report = good("x\n\x1b[2J");
  one.take(0, {report}, kNow_us);
  report = good("b");
  report.is_pressure_height = true;
  report.horizontal_sd_m = 3.0;
  report.velocity_enu_m_s = {1.0, 2.0, 3.0};
  one.take(0, {report}, kNow_us);
  const auto live = one.live(kNow_us);
  ASSERT_EQ(live.size(), 2U);
  const InputRules rules;
  EXPECT_EQ(live[0].id, "tak.b");
  EXPECT_EQ(live[0].horizontal_sd_m, 3.0);
  EXPECT_EQ(live[0].vertical_sd_m, rules.pressure_height_sd_m);
  EXPECT_EQ(live[0].velocity_sd_m_s, rules.velocity_sd_m_s);
  EXPECT_EQ(live[0].velocity_enu_m_s, (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ(live[1].id.substr(0, 11), "tak.x??[2J~") << "nothing that a terminal obeys";
  EXPECT_EQ(live[1].horizontal_sd_m, rules.horizontal_sd_m);
  EXPECT_EQ(live[1].vertical_sd_m, rules.vertical_sd_m);
  EXPECT_EQ(live[1].velocity_sd_m_s, rules.speed_sd_m_s);
}

TEST(LiveCues, RefusesByReasonWhatNoStationCanBeLedTo) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    Report report = good();
    report.latitude_deg = bad;
    expect_refused(report, "not_finite");
    report = good();
    report.horizontal_sd_m = bad;
    expect_refused(report, "not_finite");
    report = good();
    report.velocity_enu_m_s = {0.0, bad, 0.0};
    expect_refused(report, "not_finite");
  }
  Report report = good();
  report.latitude_deg = 90.0;
  expect_refused(report, "at_the_pole");
  report.latitude_deg = 91.0;
  expect_refused(report, "out_of_range");
  report = good();
  report.height_m = 1e6;
  expect_refused(report, "out_of_range");
  report = good();
  report.horizontal_sd_m = 0.0;
  expect_refused(report, "out_of_range");
  report = good();
  report.longitude_deg = 17.1;
  expect_refused(report, "out_of_area");
}

TEST(LiveCues, RefusesWhatIsNotOfThePresent) {
  expect_refused(good(), "stale", kNow_us + 10'100'000);
  expect_refused(good(), "future", kNow_us - 1'100'000);
  Report report = good();
  report.utime_us = std::numeric_limits<std::int64_t>::min();
  expect_refused(report, "stale");
  report.utime_us = std::numeric_limits<std::int64_t>::max();
  expect_refused(report, "future");
  report = good();
  report.stale_us = kNow_us + 1'000'000;  // its source no longer stands by it
  expect_refused(report, "stale", kNow_us + 1'100'000);
}

TEST(LiveCues, ACueLastsAsLongAsItsSourceStandsByIt) {
  LiveCues one = live_cues();
  Report report = good();
  report.stale_us = kNow_us + 3'000'000;
  one.take(0, {report, good("b")}, kNow_us);
  EXPECT_EQ(one.live(kNow_us + 2'900'000).size(), 2U);
  EXPECT_EQ(one.live(kNow_us + 3'100'000).size(), 1U);
  EXPECT_EQ(one.live(kNow_us + 10'100'000).size(), 0U);
}

TEST(LiveCues, AnOvertakenPlaceIsStaleAndAFullDeskSaysSo) {
  LiveCues one = live_cues(2);
  Report newer = good();
  newer.utime_us += 500'000;
  newer.height_m = 500.0;
  one.take(0, {newer, good()}, kNow_us + 500'000);
  EXPECT_EQ(one.live(kNow_us).front().height_m, 500.0);
  EXPECT_EQ(one.counts()[0].refused.at("stale"), 1);
  one.take(0, {good("b"), good("c")}, kNow_us);
  EXPECT_EQ(one.live(kNow_us).size(), 2U);
  EXPECT_EQ(one.counts()[0].refused.at("too_many"), 1);
  EXPECT_EQ(one.counts()[0].last_refusal, "c: too many cues");
}

TEST(LiveCues, OneInputDoesNotTakeTheOthersPlaces) {
  InputRules first, second;
  first.name = "a";
  second.name = "b";
  LiveCues one({first, second}, 5);
  one.take(0, {good("1"), good("2"), good("3"), good("4"), good("5"), good("6")}, kNow_us);
  EXPECT_EQ(one.counts()[0].refused.at("too_many"), 4);
  one.take(1, {good("1"), good("2")}, kNow_us);
  EXPECT_EQ(one.counts()[1].taken, 2);
  EXPECT_EQ(one.live(kNow_us).size(), 4U);
  LiveCues narrow({first, second}, 1);
  narrow.take(1, {good()}, kNow_us);
  EXPECT_EQ(narrow.live(kNow_us).size(), 1U) << "each has a place";
}

TEST(LiveCues, DifferentObjectsStayDifferent) {
  LiveCues one = live_cues();
  one.take(0, {good("\xc5\x99"), good("\xc5\x88"), good("??")}, kNow_us);
  const auto live = one.live(kNow_us);
  ASSERT_EQ(live.size(), 3U);
  EXPECT_EQ(live[0].id, "tak.??") << "as it came";
  one.take(0, {good("\xc5\x99")}, kNow_us);
  EXPECT_EQ(one.live(kNow_us).size(), 3U) << "the same name again is the same object";
  one.take(0, {good(std::string(60, 'n')), good(std::string(61, 'n'))}, kNow_us);
  EXPECT_EQ(one.live(kNow_us).size(), 4U);
  EXPECT_EQ(one.counts()[0].refused.at("malformed"), 1);
}

TEST(LiveCues, AClockThatIsSetBackLeavesNothingInTheFuture) {
  constexpr std::int64_t kBack_us = 5'000'000;
  LiveCues one = live_cues();
  one.take(0, {good()}, kNow_us);
  Report fresh = good();
  fresh.utime_us -= kBack_us;
  one.take(0, {fresh}, kNow_us - kBack_us);
  EXPECT_EQ(one.counts()[0].refused.at("stale"), 0);
  ASSERT_EQ(one.live(kNow_us - kBack_us).size(), 1U);
  EXPECT_EQ(one.live(kNow_us - kBack_us)[0].utime_us, fresh.utime_us);
  EXPECT_TRUE(one.live(kNow_us - 2 * kBack_us).empty());
}

TEST(LiveCues, CountsWhatAReaderRefused) {
  LiveCues one = live_cues();
  one.take(0, {Refused{Refusal::kOwn, "brno.target.1.7"}}, kNow_us);
  EXPECT_EQ(one.counts()[0].refused.at("own"), 1);
}

TEST(LiveCues, AnAreaMayCrossTheDateLine) {
  InputRules rules;
  rules.name = "x";
  rules.area_deg = {-20.0, 175.0, -10.0, -175.0};
  LiveCues one({rules}, 8);
  Report report = good();
  report.latitude_deg = -15.0;
  report.longitude_deg = 179.0;
  one.take(0, {report}, kNow_us);
  report.longitude_deg = 0.0;
  one.take(0, {report}, kNow_us);
  EXPECT_EQ(one.counts()[0].taken, 1);
  EXPECT_EQ(one.counts()[0].refused.at("out_of_area"), 1);
}

}  // namespace
}  // namespace ols::cues
