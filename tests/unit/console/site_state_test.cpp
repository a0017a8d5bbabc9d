#include "console/site_state.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

ReceivedStation station(const std::string& id, const std::vector<std::string>& alarms = {}) {
  ReceivedStation heard;
  heard.id = id;
  heard.fields = {{"state", "tracking"}, {"alarms", alarms}};
  heard.alarms = alarms_of(alarms);
  return heard;
}

ReceivedTarget target(const std::string& id, double latitude_deg = 49.0) {
  ReceivedTarget heard;
  heard.what = ReceivedTarget::What::kPosition;
  heard.boot_id = 1;
  heard.id = id;
  heard.fields = {{"latitude_deg", latitude_deg}};
  heard.latitude_deg = latitude_deg;
  return heard;
}

std::vector<std::string> texts(const Json& events) {
  std::vector<std::string> result;
  for (const Json& event : events) result.push_back(event.at("text"));
  return result;
}

TEST(SiteState, AViewerGetsWhatChangedSinceItsLastMessage) {
  SiteState site;
  site.receive(station("alfa"), {0.0, 0});
  const Revision seen = site.revision();
  site.receive_bearing("alfa", {{"azimuth_deg", 12.0}});
  const Json changes = site.changes(seen);
  EXPECT_EQ(changes.at("kind"), "delta");
  EXPECT_EQ(changes.at("stations"),
            Json::parse(R"([{"id":"alfa","bearing":{"azimuth_deg":12.0}}])"));
  EXPECT_FALSE(changes.contains("targets"));
}

TEST(SiteState, ATargetSaysWhoTheLandHidesItFromAndItsTrailRemembers) {
  SiteState site;
  site.receive(station("alfa"), {0.0, 0});
  site.receive(station("bravo"), {0.0, 0});
  ReceivedTarget seen = target("7");
  const auto by = [&](double age_s) {
    seen.fields["stations"] = {{{"id", "alfa"}, {"used", true}, {"age_s", 0.1}},
                               {{"id", "bravo"}, {"used", true}, {"age_s", age_s}}};
    return seen;
  };
  const ReceivedOcclusion hides{"alfa", "7", true, 1'000'000, 5'000'000, 2.0};
  site.receive(ReceivedOcclusion{"forged", "7", true, 1, 2, 9.0}, {0.0, 0});
  site.receive(by(0.1), {1.0, 0});
  site.receive(hides, {1.0, 0});
  site.receive(by(0.1), {1.5, 0});
  ReceivedOcclusion again = hides;
  again.utime_us = 2'000'000;
  site.receive(again, {2.0, 0});
  site.receive(by(3.0), {2.1, 0});
  Json known = site.snapshot().at("targets")[0];
  EXPECT_EQ(known.at("hidden").dump(),
            R"({"all":true,"from":[{"back_us":5000000,"id":"alfa","since_us":1000000}]})");
  EXPECT_EQ(known.at("trail")[0].size(), 3U);
  EXPECT_EQ(known.at("trail")[1][3], Json({"alfa"}));
  EXPECT_EQ(known.at("trail")[2][3], Json({"alfa", "*"}));
  site.receive(ReceivedOcclusion{"alfa", "8", true, 1, 2, 9.0}, {2.2, 0});
  site.look({2.3, 0});
  EXPECT_TRUE(site.snapshot().at("targets")[0].at("hidden").is_null()) << "of another target";
  site.receive(hides, {2.4, 0});
  site.look({4.3, 0});
  EXPECT_FALSE(site.snapshot().at("targets")[0].at("hidden").is_null());
  site.look({4.5, 0});
  EXPECT_TRUE(site.snapshot().at("targets")[0].at("hidden").is_null()) << "it no longer holds";
}

TEST(SiteState, ABearingOfAnUnknownStationIsIgnored) {
  SiteState site;
  site.receive_bearing("forged", {{"azimuth_deg", 12.0}});
  EXPECT_TRUE(site.snapshot().at("stations").empty());
}

TEST(SiteState, AlarmsAndErrorsBecomeEvents) {
  SiteState site;
  site.receive(station("alfa", {"ptu: homing"}), {0.0, 1});
  site.receive(station("alfa"), {0.5, 2});
  ReceivedStation failed = station("alfa");
  failed.last_error = "camera lost";
  failed.last_error_utime_us = 7;
  site.receive(failed, {1.0, 3});
  site.receive(failed, {1.5, 4});
  const Json events = site.snapshot().at("events");
  EXPECT_EQ(texts(events), (std::vector<std::string>{"ptu: homing", "camera lost"}));
  EXPECT_EQ(events[1].at("times"), 1) << "the same status twice is one error";
  EXPECT_EQ(events[0].at("kind"), "alarm");
  EXPECT_EQ(events[0].at("over_us"), 2);
}

TEST(SiteState, ASilentStationIsMarkedAndSaid) {
  SiteState site;
  site.receive(station("alfa"), {0.0, 1});
  site.look({SiteState::kStationStale_s + 0.1, 2});
  EXPECT_TRUE(site.snapshot().at("stations")[0].at("stale"));
  EXPECT_EQ(site.snapshot().at("events").back().at("key"), "station_silent");
  EXPECT_TRUE(site.snapshot().at("events").back().at("over_us").is_null());
  site.receive(station("alfa"), {SiteState::kStationStale_s + 0.2, 3});
  EXPECT_EQ(site.snapshot().at("events").back().at("over_us"), 3);
}

TEST(SiteState, ATargetHasATrailThatIsThinnedAndBounded) {
  SiteState site;
  for (int i = 0; i < 20000; ++i) {
    site.receive(target("1", 49.0 + 1e-6 * i), {0.1 * i, 0});
  }
  const Json trail = site.snapshot().at("targets")[0].at("trail");
  EXPECT_EQ(trail.size(), SiteState::kMostTrailPoints);
  EXPECT_NEAR(trail.back()[1].get<double>() - trail[trail.size() - 2][1].get<double>(), 4e-6,
              1.1e-6);
}

TEST(SiteState, ATrailIsBrokenWhereTheTargetWasNotSeen) {
  SiteState site;
  double now_s = 0.0;
  for (int i = 0; i < 4; ++i) site.receive(target("1"), {now_s += 0.5, 0});
  for (int i = 0; i < 3; ++i) site.receive(target("1"), {now_s += i == 0 ? 3.0 : 0.5, 0});
  const Json trail = site.snapshot().at("targets")[0].at("trail");
  ASSERT_EQ(trail.size(), 8U);
  EXPECT_TRUE(trail[4].is_null());
}

TEST(SiteState, APositionGetsNoYoungerByWordsWithoutOne) {
  SiteState site;
  ReceivedTarget heard = target("1");
  heard.fields["utime_us"] = 1;
  site.receive(heard, {0.0, 0});
  heard.what = ReceivedTarget::What::kNoPosition;
  heard.fields = {{"utime_us", 2}, {"state", "coasted"}};
  site.receive(heard, {0.1, 0});
  const Json shown = site.snapshot().at("targets")[0];
  EXPECT_EQ(shown.at("utime_us"), 1);
  EXPECT_EQ(shown.at("state"), "coasted");
}

TEST(SiteState, ADroppedTargetIsGone) {
  SiteState site;
  site.receive(target("1"), {0.0, 0});
  const Revision seen = site.revision();
  ReceivedTarget dropped = target("1");
  dropped.what = ReceivedTarget::What::kDropped;
  site.receive(dropped, {0.1, 0});
  EXPECT_EQ(site.changes(seen).at("gone").at("targets"), Json::parse(R"(["1"])"));
  EXPECT_TRUE(site.snapshot().at("targets").empty());
}

TEST(SiteState, ARestartedFusionsIdsMeanOtherObjects) {
  SiteState site;
  site.receive(target("1"), {0.0, 0});
  ReceivedTarget other = target("2");
  other.boot_id = 2;
  site.receive(other, {SiteState::kFusionGone_s + 0.1, 0});
  const Json targets = site.snapshot().at("targets");
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].at("id"), "2");
  EXPECT_EQ(texts(site.snapshot().at("events")).back(), "the fusion was restarted");
}

TEST(SiteState, AnotherFusionIsNotHeardWhileTheFirstIs) {
  SiteState site;
  ReceivedTarget forged = target("2");
  forged.boot_id = 2;
  ReceivedFusion status;
  status.boot_id = 2;
  for (int i = 0; i < 10; ++i) {
    site.receive(target("1"), {1.0 * i, 0});
    site.receive(forged, {1.0 * i + 0.5, 0});
    site.receive(status, {1.0 * i + 0.5, 0});
  }
  const Json state = site.snapshot();
  ASSERT_EQ(state.at("targets").size(), 1U);
  EXPECT_EQ(state.at("targets")[0].at("id"), "1");
  EXPECT_EQ(state.at("targets")[0].at("trail").size(), 10U);
  EXPECT_TRUE(state.at("events").empty());
}

TEST(SiteState, TheAlarmsOfAStationAreBounded) {
  SiteState site;
  std::vector<std::string> alarms;
  for (int i = 0; i < 300; ++i) alarms.emplace_back(1, static_cast<char>('a' + i % 26));
  for (int i = 0; i < 300; ++i) alarms[i] += std::string(1, static_cast<char>('a' + i / 26));
  site.receive(station("alfa", alarms), {0.0, 1});
  EXPECT_EQ(site.snapshot().at("events").size(), SiteState::kMostAlarms);
}

TEST(SiteState, ForgedNamesAreBoundedAndCounted) {
  SiteState site;
  for (std::size_t i = 0; i < SiteState::kMostStations + 5; ++i) {
    site.receive(station(std::to_string(i)), {0.0, 0});
  }
  EXPECT_EQ(site.station_ids().size(), SiteState::kMostStations);
  EXPECT_EQ(site.refused(), 5U);
  EXPECT_EQ(site.counts().at("stations"), SiteState::kMostStations);
}

}  // namespace
}  // namespace ols::console
