#include "central/fusion/slew_schedule.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "tests/unit/central/given_tracks.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::confirm_at;
using test::GivenTracks;
using test::kStart;
using test::sight_of;
using test::site;

const Vector3d kPlace(0.0, 300.0, 50.0);
constexpr double kGiveUp_s = 1.0;
constexpr std::int64_t kPeriodUs = 100'000;  // of a round, by default

class SlewScheduleTest : public testing::Test {
 protected:
  void know(const std::string& name, const Vector3d& p_enu) {
    KnownStation& station = *stations.for_status(name, time).station;
    station.traits.camera_ecef = site().to_ecef(p_enu);
  }
  // s00, s01, ...: all look for the one target.
  void know_many(int count) {
    for (int i = 0; i < count; ++i) {
      char name[16];
      std::snprintf(name, sizeof name, "s%02d", i);
      know(name, {10.0 * i, -100.0, 0.0});
    }
    now_us = confirm_at(tracks, kPlace);
    ASSERT_EQ(tracks.tracks().at(0).state, TrackState::kConfirmed);
  }
  std::vector<Slew> plan(const CueRegistry& book = CueRegistry({})) {
    const BearingLines lines(tracks, pointing, alignment, true);
    return schedule.plan(now_us, stations, lines, tracks.tracks(), book, handover);
  }
  static std::vector<std::string> names(const std::vector<Slew>& slews) {
    std::vector<std::string> found;
    for (const Slew& slew : slews) found.push_back(slew.station);
    return found;
  }
  // A station follows something of its own, by this local track.
  void follow(std::size_t station, std::int64_t track_id, const Vector3d& p_enu,
              bool is_tracklet = false, bool is_acquired = false) {
    for (int i = 0; i < 4; ++i) {
      BearingMeasurement measurement = sight_of(station, p_enu, now_us - 20'000 * (3 - i));
      measurement.track_id = track_id;
      measurement.is_tracklet = is_tracklet;
      measurement.is_acquired = is_acquired;
      tracks.keep_unassociated(measurement);
    }
  }

  MessageTime time;
  StationRegistry stations{{}, 100};
  GivenTracks tracks;
  PointingMonitor pointing;
  AlignmentConfig alignment;
  HandoverPolicy handover{{}};
  SlewSchedule schedule{SlewConfig{}, kGiveUp_s};
  std::int64_t now_us = kStart;
};

TEST_F(SlewScheduleTest, ARoundIsSharedAmongBearingsAndHasEachStationOnce) {
  know_many(40);
  std::vector<std::string> all;
  for (const std::size_t share : {16U, 16U, 8U}) {
    now_us += 1000;
    const auto slews = plan();
    EXPECT_EQ(slews.size(), share);
    for (const Slew& slew : slews) {
      EXPECT_EQ(slew.target_id, 1);
      EXPECT_EQ(slew.utime_us, now_us) << "for the time of its creation, not of the round";
      all.push_back(slew.station);
    }
    EXPECT_EQ(schedule.is_in_round(), share == 16U);
  }
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 40U);
  EXPECT_TRUE(plan().empty()) << "until the next one is due";
  now_us += kPeriodUs;
  EXPECT_EQ(names(plan()).front(), "s00");
}

TEST_F(SlewScheduleTest, ARoundThatTakesTooLongIsBegunAnew) {
  know_many(40);
  plan();
  now_us += std::llround(kGiveUp_s * 1e6) - 1000;
  EXPECT_EQ(names(plan()).front(), "s16");
  now_us += 2000;
  EXPECT_EQ(names(plan()).front(), "s00");
}

TEST_F(SlewScheduleTest, AfterAStepBackOfTimeARoundBeginsAtOnce) {
  know_many(20);
  plan();
  plan();
  ASSERT_FALSE(schedule.is_in_round());
  now_us -= 400'000;
  EXPECT_TRUE(plan().empty()) << "cues and bearings differ by as much";
  now_us -= 200'000;
  EXPECT_EQ(names(plan()).front(), "s00");
}

TEST_F(SlewScheduleTest, AStationThatGoesInTheMiddleOfARoundEndsNothing) {
  know_many(20);
  plan();
  stations.all().erase("s16");  // it would be the next
  EXPECT_EQ(names(plan()), (std::vector<std::string>{"s17", "s18", "s19"}));
}

TEST_F(SlewScheduleTest, WhomTheOperatorHasGetsNoSlew) {
  know_many(3);
  stations.all().at("s01").traits.commandable = false;
  EXPECT_EQ(names(plan()), (std::vector<std::string>{"s00", "s02"}));
}

TEST_F(SlewScheduleTest, ATrackerLetsGoOfWhatAnOperatorHasDismissed) {
  for (const char* name : {"a", "b"}) know(name, {0.0, 0.0, 0.0});
  now_us = confirm_at(tracks, kPlace);
  BearingMeasurement followed = sight_of(1, kPlace, now_us + 20'000);
  followed.track_id = 7;
  tracks.give(0, followed);
  stations.all().at("b").traits.axis = {0.3, 0.1};
  handover = HandoverPolicy({.mode = HandoverMode::kPropose});
  handover.settle(now_us, tracks.tracks());
  EXPECT_EQ(plan().size(), 2U);
  ASSERT_TRUE(handover.order(1, false));
  now_us += kPeriodUs;
  const auto slews = plan();
  ASSERT_EQ(names(slews), std::vector<std::string>{"b"}) << "no tracker of a follows it";
  EXPECT_EQ(slews[0].let_go_track_id, 7);
  EXPECT_EQ(slews[0].target_id, 0);
  EXPECT_EQ(slews[0].direction.azimuth_rad, 0.3) << "where it is: nothing else wants it";
}

// Neither the class of its target nor a line takes a tracker that an operator has started.
TEST_F(SlewScheduleTest, WhatAnOperatorHasDesignatedIsNotLetGo) {
  for (std::size_t k = 0; k < 4; ++k) {
    know(std::string(1, static_cast<char>('a' + k)), test::square()[k]);
  }
  now_us = confirm_at(tracks, kPlace);
  for (int i = 0; i < 10; ++i, now_us += kPeriodUs) {
    for (const std::size_t k : {0U, 1U, 2U}) {
      BearingMeasurement own = sight_of(k, kPlace, now_us);
      own.track_id = 11;
      tracks.give(0, own);
      KnownStation& station = stations.all().at(own.station);
      station.target_id = 1;
      station.saw_target.note(now_us);
    }
    follow(3, 7, {-300.0, 200.0, 90.0}, true);
    for (const Slew& slew : plan()) EXPECT_EQ(slew.let_go_track_id, 0) << slew.station;
  }
}

// The policy looks at its targets ten times a second: what is designated between two looks stays.
TEST_F(SlewScheduleTest, ADesignationIsNotUndoneBeforeThePolicyKnowsOfIt) {
  for (const char* name : {"a", "b"}) {
    know(name, {0.0, 0.0, 0.0});
    stations.all().at(name).traits.axis = {0.3, 0.1};
  }
  tracks.begin_at(kPlace, now_us);
  // Both stations' trackers, at ten images.
  const auto follow_as = [&](std::size_t object_class, std::int64_t track_id, bool is_acquired) {
    for (int i = 0; i < 10; ++i, now_us += 20'000) {
      for (const std::size_t k : {0U, 1U}) {
        BearingMeasurement own = sight_of(k, kPlace, now_us);
        own.track_id = track_id;
        own.is_acquired = is_acquired;
        own.sighted.class_probability.assign(5, 0.02);
        own.sighted.class_probability[object_class] = 0.92;
        tracks.give(0, own);
      }
    }
  };
  const auto let_go = [&] {
    std::set<std::int64_t> ids;
    for (const Slew& slew : plan()) ids.insert(slew.let_go_track_id);
    return ids;
  };
  handover = HandoverPolicy({.mode = HandoverMode::kAutomatic, .classes = {ObjectClass::kDrone}});
  for (const std::size_t object_class : {1U, 2U}) {
    follow_as(object_class, 11, true);
    handover.settle(now_us, tracks.tracks());
  }
  EXPECT_TRUE(let_go().contains(11)) << "it is a bird";
  follow_as(2, 12, false);
  EXPECT_FALSE(let_go().contains(12));
}

TEST_F(SlewScheduleTest, OneOfThreeTrackersIsLentToTheLineOfAnotherObject) {
  for (std::size_t k = 0; k < 4; ++k) {
    know(std::string(1, static_cast<char>('a' + k)), test::square()[k]);
  }
  now_us = confirm_at(tracks, kPlace);
  std::vector<Slew> slews;
  for (int i = 0; i < 10; ++i, now_us += kPeriodUs) {
    for (const std::size_t k : {0U, 1U, 2U}) {
      BearingMeasurement own = sight_of(k, kPlace, now_us);
      own.track_id = 11;
      own.is_acquired = true;
      tracks.give(0, own);
      KnownStation& station = stations.all().at(own.station);
      station.target_id = 1;
      station.saw_target.note(now_us);
    }
    follow(3, 7, {-300.0, 200.0, 90.0}, true);
    slews = plan();
  }
  ASSERT_EQ(names(slews), (std::vector<std::string>{"a", "b", "c", "d"}));
  int lent = 0;
  for (const Slew& slew : slews) {
    const bool searches = !slew.line.isZero();
    lent += searches ? 1 : 0;
    EXPECT_EQ(slew.target_id, searches ? 0 : 1) << slew.station;
    EXPECT_EQ(slew.let_go_track_id, searches ? 11 : 0) << slew.station;
  }
  EXPECT_EQ(lent, 1);
}

// Of several lines each gets its turn; that of a station that is never led has the first.
TEST_F(SlewScheduleTest, LinesTakeTurnsAndTheOverviewsComesFirst) {
  for (std::size_t k = 0; k < 4; ++k) {
    know(std::string(1, static_cast<char>('a' + k)), test::square()[k]);
  }
  stations.all().at("d").traits.commandable = false;
  std::string order;
  for (int i = 0; i < 240; ++i, now_us += kPeriodUs) {
    follow(0, 5, {-300.0, 200.0, 90.0}, true);
    if (i > 5) follow(3, 7, kPlace, true);
    const auto slews = plan();
    const char of = slews.empty() ? '-' : names(slews).front() == "a" ? 'd' : 'a';
    if (order.empty() || order.back() != of) order += of;
  }
  EXPECT_EQ(order, "-adada-");
}

// What a led station has found by mistake does not keep it for ever.
TEST_F(SlewScheduleTest, ATrackerLetsGoOfWhatItAcquiredAndNobodyElseSees) {
  for (const char* name : {"a", "b"}) know(name, {0.0, 0.0, 0.0});
  stations.all().at("a").traits.axis = {0.3, 0.1};
  std::set<std::int64_t> let_go;
  const auto follow_for = [&](double seconds, bool is_acquired) {
    for (const std::int64_t end_us = now_us + std::llround(seconds * 1e6); now_us < end_us;
         now_us += kPeriodUs) {
      follow(0, is_acquired ? 5 : 6, kPlace, false, is_acquired);
      for (const Slew& slew : plan()) let_go.insert(slew.let_go_track_id);
    }
  };
  follow_for(9.5, true);
  EXPECT_EQ(let_go, std::set<std::int64_t>{0});
  follow_for(1.0, true);
  EXPECT_TRUE(let_go.contains(5));
  let_go.clear();
  follow_for(12.0, false);
  EXPECT_EQ(let_go, std::set<std::int64_t>{0}) << "an operator has designated it";
}

TEST_F(SlewScheduleTest, NobodySearchesForALostTargetThatLedNobody) {
  for (const char* name : {"a", "b"}) know(name, {0.0, 0.0, 0.0});
  now_us = confirm_at(tracks, kPlace) + 20'000;
  BearingMeasurement own = sight_of(0, kPlace, now_us);
  own.track_id = 5;
  own.is_tracklet = true;
  tracks.give(0, own);
  handover.settle(now_us, tracks.tracks());
  ASSERT_TRUE(handover.order(1, false));
  plan();
  tracks.clear_tracks();
  const auto led_along = [&](std::int64_t track_id) {
    std::set<std::string> led;
    for (const std::int64_t end_us = now_us + 3'000'000; now_us < end_us; now_us += kPeriodUs) {
      follow(0, track_id, kPlace, true);
      for (const Slew& slew : plan()) led.insert(slew.station);
    }
    return led;
  };
  EXPECT_EQ(led_along(5), std::set<std::string>{});
  EXPECT_EQ(led_along(6), std::set<std::string>{"b"}) << "another object";
}

// A target of two stations is lost by one of them; the other one's tracker goes on.
class LastTrackerTest : public SlewScheduleTest {
 protected:
  void SetUp() override {
    for (const char* name : {"a", "b"}) know(name, {0.0, 0.0, 0.0});
    stations.all().at("a").traits.axis = {0.3, 0.1};
    now_us = confirm_at(tracks, kPlace) + 20'000;
    BearingMeasurement own = sight_of(0, kPlace, now_us);
    own.track_id = 5;
    own.is_acquired = true;
    tracks.give(0, own);
    handover.settle(now_us, tracks.tracks());
    plan();
    tracks.clear_tracks();
  }
  // What has been let go of, and the stations that have been led anywhere.
  std::pair<std::set<std::int64_t>, std::set<std::string>> go_on_for(double seconds) {
    std::set<std::int64_t> let_go;
    std::set<std::string> led;
    for (const std::int64_t end_us = now_us + std::llround(seconds * 1e6); now_us < end_us;
         now_us += kPeriodUs) {
      follow(0, 5, kPlace, false, true);
      for (const Slew& slew : plan()) {
        let_go.insert(slew.let_go_track_id);
        if (slew.let_go_track_id == 0) led.insert(slew.station);
      }
    }
    return {let_go, led};
  }
};

TEST_F(LastTrackerTest, ItStaysThereForAMinute) {
  const auto [let_go, led] = go_on_for(59.0);
  EXPECT_EQ(let_go, std::set<std::int64_t>{0});
  EXPECT_EQ(led, std::set<std::string>{"b"}) << "the other one searches";
  EXPECT_TRUE(go_on_for(2.0).first.contains(5)) << "it may have slid onto something else";
}

TEST_F(LastTrackerTest, ItLetsGoOfWhatAnOperatorDismisses) {
  EXPECT_FALSE(go_on_for(2.0).first.contains(5));
  ASSERT_TRUE(handover.order(1, false));
  EXPECT_TRUE(go_on_for(1.0).first.contains(5));
}

TEST_F(SlewScheduleTest, WithoutATargetOrARayThereAreNone) {
  know("a", {0.0, 0.0, 0.0});
  EXPECT_TRUE(plan().empty());
  EXPECT_FALSE(schedule.is_in_round());
}

// Another ray would begin all searches anew.
TEST_F(SlewScheduleTest, StationsSearchAlongOneRayForAsLongAsItLasts) {
  for (std::size_t k = 0; k < 4; ++k) {
    know(std::string(1, static_cast<char>('a' + k)), test::square()[k]);
  }
  follow(1, 7, kPlace);
  auto slews = plan();
  ASSERT_EQ(names(slews), (std::vector<std::string>{"a", "c", "d"})) << "b has it in view";
  const Vector3d origin = site().to_ecef(test::square()[1]);
  const Vector3d ray = (site().to_ecef(kPlace) - origin).normalized();
  // Thirds of what is likely: around the foot of the middle at 259 m, half the stations' radius.
  const double begin_m[] = {205.0, 313.0, 313.0};
  for (std::size_t i = 0; i < slews.size(); ++i) {
    const Vector3d camera = stations.all().at(slews[i].station).traits.camera_ecef;
    const auto wanted = test::direction_to(camera, origin + begin_m[i] * ray);
    EXPECT_NEAR(slews[i].direction.azimuth_rad, wanted.azimuth_rad, 5e-3) << slews[i].station;
  }
  now_us += kPeriodUs;
  follow(0, 3, {-300.0, 200.0, 90.0});
  follow(1, 7, kPlace);
  slews = plan();
  ASSERT_EQ(names(slews), (std::vector<std::string>{"c", "d"}));
  for (const Slew& slew : slews) {
    EXPECT_EQ(slew.target_id, 0);
    EXPECT_FALSE(slew.line.isZero());
    const BearingMeasurement seen = sight_of(1, kPlace, now_us);
    const Vector3d camera = stations.all().at(slew.station).traits.camera_ecef;
    const Vector3d look = R_ecef_enu(camera) * enu_from_azimuth_elevation(slew.direction);
    const Vector3d base = (seen.sight.origin_ecef - camera).normalized();
    const Vector3d plane = base.cross(direction_ecef(seen.sight)).normalized();
    EXPECT_NEAR(look.dot(plane), 0.0, 0.02) << slew.station << ": in the plane with b's ray";
  }
  now_us += 2'000'000;
  follow(0, 3, {-300.0, 200.0, 90.0});
  EXPECT_EQ(names(plan()), (std::vector<std::string>{"b", "c", "d"})) << "b's has ended";
}

TEST_F(SlewScheduleTest, ATrackletThatWasAwayIsSearchedAnewAfterAWait) {
  for (std::size_t k = 0; k < 4; ++k) {
    know(std::string(1, static_cast<char>('a' + k)), test::square()[k]);
  }
  const auto rounds_in = [this](double seconds, bool is_seen = true) {
    int rounds = 0;
    for (const std::int64_t end_us = now_us + std::llround(seconds * 1e6); now_us < end_us;
         now_us += kPeriodUs) {
      if (is_seen) follow(1, 7, kPlace, true);
      rounds += plan().empty() ? 0 : 1;
    }
    return rounds;
  };
  EXPECT_NEAR(rounds_in(15.0), 100, 2);
  rounds_in(1.5, false);
  EXPECT_EQ(rounds_in(3.0), 0) << "hidden for a moment";
  rounds_in(2.5, false);
  EXPECT_NEAR(rounds_in(2.0), 13, 1);
}

TEST_F(SlewScheduleTest, ACueIsAPlaceToLookAt) {
  know("a", test::square()[0]);
  CueRegistry book({.allow = CueAllowance::kAll});
  Cue cue;
  cue.id = "x";
  cue.utime_us = cue.state_us = now_us;
  cue.place = geodetic_from_ecef(site().to_ecef(kPlace));
  cue.horizontal_sd_m = cue.vertical_sd_m = 1.0;
  cue.velocity_sd_m_s = 1.0;
  ASSERT_EQ(book.take(cue, now_us, stations), CueRefusal::kNone);
  const auto slews = plan(book);
  ASSERT_EQ(slews.size(), 1U);
  EXPECT_EQ(slews[0].target_id, 0);
  const auto wanted = test::direction_to(site().to_ecef(test::square()[0]), site().to_ecef(kPlace));
  EXPECT_NEAR(slews[0].direction.azimuth_rad, wanted.azimuth_rad, 1e-3);
  EXPECT_NEAR(slews[0].direction.elevation_rad, wanted.elevation_rad, 1e-3);
}

TEST_F(SlewScheduleTest, ClearedItBeginsARoundAtOnce) {
  know_many(20);
  plan();
  ASSERT_TRUE(schedule.is_in_round());
  schedule.clear();
  EXPECT_FALSE(schedule.is_in_round());
  EXPECT_EQ(names(plan()).front(), "s00");
}

}  // namespace
}  // namespace ols::fusion
