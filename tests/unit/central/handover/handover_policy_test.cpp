#include "central/handover/handover_policy.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::kStart;
using test::site;

const Vector3d kPlace(0.0, 300.0, 50.0);

class TheHandoverPolicy : public testing::Test {
 protected:
  static HandoverPolicy with(HandoverMode mode) {
    HandoverConfig config;
    config.mode = mode;
    return HandoverPolicy(config);
  }
  static std::int64_t after(double s) { return kStart + std::llround(1e6 * s); }

  // A target that two stations see, by their detectors or by their trackers.
  static Track track_of(std::int64_t id, bool by_detectors, const Vector3d& p_enu = kPlace,
                        double at_s = 0.0) {
    Track track(TrackFilter(
        {}, after(at_s),
        {.p_ecef = site().to_ecef(p_enu), .position_sd_m = 2.0, .velocity_sd_m_s = 1.0}));
    track.id = id;
    track.state = TrackState::kConfirmed;
    for (const std::size_t k : {0U, 1U}) {
      const std::string station(1, static_cast<char>('a' + k));
      BearingMeasurement m =
          test::measurement_of(test::ray_to(station, test::square()[k], p_enu, 1e-4), after(at_s));
      m.is_tracklet = by_detectors;
      track.bearings[station].push_back(m);
      track.last.note(m);
    }
    return track;
  }
  static Track of_class(std::size_t object_class) {
    Track track = track_of(1, true);
    for (auto& [station, own] : track.bearings) {
      own.back().sighted.class_probability.assign(5, 0.02);
      own.back().sighted.class_probability[object_class] = 0.92;
      track.last.note(own.back());
    }
    return track;
  }
  // The trackers of led stations are on it now.
  static Track followed(Track track) {
    for (auto& [station, own] : track.bearings) {
      own.back().is_tracklet = false;
      own.back().is_acquired = true;
      track.last.note(own.back());
    }
    return track;
  }
  static CueState state(const HandoverPolicy& handover) {
    return handover.health(kStart).at(0).state;
  }
};

TEST_F(TheHandoverPolicy, ItsModeChangesAtOnceAndDecisionsStay) {
  HandoverPolicy handover = with(HandoverMode::kOff);
  const Track track = track_of(1, true);
  handover.settle(kStart, {track});
  EXPECT_EQ(handover.priority(track), 0.0);
  handover.set_mode(HandoverMode::kAutomatic);
  EXPECT_GT(handover.priority(track), 0.0);
  EXPECT_TRUE(handover.order(1, false));
  handover.set_mode(HandoverMode::kPropose);
  EXPECT_EQ(state(handover), CueState::kForbidden);
  EXPECT_TRUE(handover.order(1, true));
  EXPECT_GT(handover.priority(track), 0.0);
  handover.set_mode(HandoverMode::kOff);
  EXPECT_EQ(handover.priority(track), 0.0) << "nobody is led in mode off, allowed or not";
  EXPECT_TRUE(handover.order(1, false)) << "a dismissal counts in every mode";
  for (const auto mode : {HandoverMode::kOff, HandoverMode::kPropose, HandoverMode::kAutomatic}) {
    EXPECT_EQ(handover_mode_named(to_string(mode)), mode);
  }
  EXPECT_FALSE(handover_mode_named(""));
}

TEST_F(TheHandoverPolicy, OffTargetsOfDetectionsLeadNobodyAndDesignatedOnesDo) {
  HandoverPolicy off = with(HandoverMode::kOff);
  const std::vector<Track> tracks = {track_of(1, true), track_of(2, false)};
  off.settle(kStart, tracks);
  EXPECT_EQ(off.priority(tracks[0]), 0.0);
  EXPECT_GT(off.priority(tracks[1]), 0.0);
  EXPECT_FALSE(off.order(1, true));
  EXPECT_TRUE(off.health(kStart).empty());
  EXPECT_GT(off.priority(track_of(3, false)), 0.0) << "not known yet";
}

// The tracker loses it for a while; its designation does not end.
TEST_F(TheHandoverPolicy, WhatWasDesignatedStaysSo) {
  HandoverPolicy off = with(HandoverMode::kOff);
  off.settle(kStart, {track_of(1, false)});
  off.settle(after(1.0), {track_of(1, true)});
  EXPECT_GT(off.priority(track_of(1, true)), 0.0);
}

TEST_F(TheHandoverPolicy, AProposalWaitsForTheOperatorsWord) {
  HandoverPolicy handover = with(HandoverMode::kPropose);
  const Track track = track_of(1, true);
  handover.settle(kStart, {track});
  EXPECT_EQ(state(handover), CueState::kWaiting);
  EXPECT_EQ(handover.health(kStart).at(0).id, "1");
  EXPECT_EQ(handover.priority(track), 0.0);
  EXPECT_FALSE(handover.order(2, true)) << "there is none";
  EXPECT_TRUE(handover.order(1, true));
  EXPECT_EQ(state(handover), CueState::kFound);
  EXPECT_GT(handover.priority(track), 0.0);
  EXPECT_TRUE(handover.order(1, false));
  EXPECT_EQ(state(handover), CueState::kForbidden);
  EXPECT_EQ(handover.priority(track), 0.0);
  EXPECT_TRUE(handover.is_let_go(1));
}

// A station that searched along a line has found it: its tracker came first.
TEST_F(TheHandoverPolicy, WhatALedStationHasAcquiredIsNoOperatorsTarget) {
  HandoverPolicy handover = with(HandoverMode::kAutomatic);
  Track track = track_of(1, false);
  handover.settle(kStart, {track});
  EXPECT_TRUE(handover.is_wanted(1));
  for (auto& [station, own] : track.bearings) own.back().is_acquired = true;
  handover.clear();
  handover.settle(kStart, {track});
  EXPECT_FALSE(handover.is_wanted(1));
}

TEST_F(TheHandoverPolicy, ThePriorityIsTheProbabilityThatItsClassLeads) {
  HandoverConfig config;
  config.mode = HandoverMode::kAutomatic;
  config.classes = {ObjectClass::kUnknown, ObjectClass::kDrone};
  HandoverPolicy handover(config);
  const auto priority_of = [&](const ClassLook& look) {
    Track track = track_of(1, true);
    track.classes.add(kStart, look);
    handover.clear();
    handover.settle(kStart, {track});
    return handover.priority(track);
  };
  const double any = priority_of({});
  EXPECT_NEAR(any, 0.25 * track_of(1, true).existence.probability(), 1e-9) << "one of four classes";
  const Measured size{0.6, 0.1}, speed{12.0, 0.5};
  EXPECT_GT(priority_of({.size_m = size, .speed_m_s = speed, .flicker = {0.0, 0.003}}), 1.5 * any);
  EXPECT_LT(priority_of({.size_m = size, .speed_m_s = speed, .flicker = {0.05, 0.003}}), any / 1.5);
}

// The led stations' trackers follow it then, and are no word of an operator.
TEST_F(TheHandoverPolicy, ADismissedTargetLeadsNobodyAlsoWhereATrackerFollowsIt) {
  HandoverPolicy handover = with(HandoverMode::kAutomatic);
  handover.settle(kStart, {track_of(1, true)});
  handover.settle(after(1.0), {track_of(1, false)});
  EXPECT_TRUE(handover.order(1, false));
  handover.settle(after(2.0), {track_of(1, false)});
  EXPECT_EQ(handover.priority(track_of(1, false)), 0.0);
}

TEST_F(TheHandoverPolicy, WhoDesignatesWhatWasDismissedHasChangedHisMind) {
  for (const HandoverMode mode : {HandoverMode::kOff, HandoverMode::kAutomatic}) {
    HandoverPolicy handover = with(mode);
    const Track before = track_of(1, false);
    handover.settle(kStart, {before});
    EXPECT_TRUE(handover.order(1, false));
    handover.settle(after(1.0), {before});
    EXPECT_TRUE(handover.is_let_go(1));
    handover.settle(after(2.0), {followed(before)});
    EXPECT_TRUE(handover.is_let_go(1)) << "a tracker that was led there is nobody's word";
    Track anew = track_of(1, false);
    anew.bearings.begin()->second.back().track_id = 77;
    handover.settle(after(3.0), {anew});
    EXPECT_FALSE(handover.is_let_go(1));
    EXPECT_GT(handover.priority(anew), 0.0);
    EXPECT_TRUE(handover.is_wanted(1));
  }
}

TEST_F(TheHandoverPolicy, AProposalThatAnOperatorDesignatesLeads) {
  HandoverPolicy handover = with(HandoverMode::kPropose);
  handover.settle(kStart, {track_of(1, true)});
  handover.settle(after(1.0), {track_of(1, false)});
  EXPECT_GT(handover.priority(track_of(1, true)), 0.0);
  EXPECT_TRUE(handover.health(after(1.0)).empty()) << "no proposal any more";
}

TEST_F(TheHandoverPolicy, AutomaticLeadsAtOnceButNotWhatIsOfAnotherClass) {
  HandoverConfig config;
  config.mode = HandoverMode::kAutomatic;
  config.classes = {ObjectClass::kDrone};
  HandoverPolicy handover(config);
  const Track drone = of_class(1), bird = of_class(2);
  handover.settle(kStart, {drone});
  EXPECT_GT(handover.priority(drone), 0.0);
  EXPECT_FALSE(handover.is_let_go(1));
  handover.settle(after(1.0), {bird});
  EXPECT_TRUE(handover.is_let_go(1)) << "it has been led to until its class was known";
  EXPECT_EQ(handover.priority(bird), 0.0);
  EXPECT_EQ(state(handover), CueState::kWaiting);
  handover.settle(after(2.0), {followed(bird)});
  EXPECT_EQ(handover.priority(bird), 0.0) << "those trackers were led there, not designated";
  handover.order(1, true);
  EXPECT_GT(handover.priority(bird), 0.0) << "the operator's word wins";
  EXPECT_FALSE(handover.is_let_go(1));
}

TEST_F(TheHandoverPolicy, TheOperatorsTargetIsWorthMoreAndADoubtfulOneLess) {
  HandoverPolicy handover = with(HandoverMode::kAutomatic);
  Track doubtful = track_of(2, true);
  doubtful.existence.begin();
  const Track own = track_of(1, false), found = track_of(3, true);
  handover.settle(kStart, {own, doubtful, found});
  EXPECT_GT(handover.priority(own), handover.priority(found));
  EXPECT_GT(handover.priority(found), handover.priority(doubtful));
}

TEST_F(TheHandoverPolicy, ALostTargetIsSoughtWhereItMustBeAndThenGivenUp) {
  HandoverPolicy handover = with(HandoverMode::kAutomatic);
  handover.settle(kStart, {track_of(1, true)});
  EXPECT_TRUE(handover.lost(kStart).empty());
  handover.settle(after(4.0), {});
  const auto lost = handover.lost(after(4.0));
  ASSERT_EQ(lost.size(), 1U);
  const auto soon = lost[0].at(after(4.0)), late = lost[0].at(after(9.0));
  EXPECT_LT((soon.mean.head<3>() - site().to_ecef(kPlace)).norm(), 1.0);
  EXPECT_GT(late.covariance(0, 0), 2.0 * soon.covariance(0, 0));
  EXPECT_EQ(handover.health(after(4.0)).at(0).state, CueState::kSearched);
  handover.settle(after(10.5), {});
  EXPECT_TRUE(handover.lost(after(10.5)).empty());
  EXPECT_TRUE(handover.health(after(10.5)).empty());
}

TEST_F(TheHandoverPolicy, ALostTargetThatIsFoundUnderAnotherNumberIsNotSoughtAnyMore) {
  HandoverPolicy handover = with(HandoverMode::kAutomatic);
  handover.settle(kStart, {track_of(1, true)});
  handover.settle(after(3.0), {});
  ASSERT_EQ(handover.lost(after(3.0)).size(), 1U);
  handover.settle(after(4.0), {track_of(2, true, kPlace + Vector3d(4, 0, 0), 4.0)});
  EXPECT_TRUE(handover.lost(after(4.0)).empty());
}

TEST_F(TheHandoverPolicy, AProposalThatIsLostIsNotSought) {
  HandoverPolicy handover = with(HandoverMode::kPropose);
  handover.settle(kStart, {track_of(1, true)});
  handover.settle(after(3.0), {});
  EXPECT_TRUE(handover.lost(after(3.0)).empty());
  EXPECT_TRUE(handover.health(after(3.0)).empty());
}

TEST_F(TheHandoverPolicy, NotThisOneHoldsUnderAnotherNumberNearbyAndOnlyThere) {
  HandoverPolicy handover = with(HandoverMode::kAutomatic);
  handover.settle(kStart, {track_of(1, true)});
  EXPECT_TRUE(handover.order(1, false));
  handover.settle(after(3.0), {});
  EXPECT_TRUE(handover.lost(after(3.0)).empty()) << "not looked for";
  const Track again = track_of(2, true, kPlace + Vector3d(5, 0, 0), 4.0);
  const Track other = track_of(3, true, kPlace + Vector3d(400, 0, 0), 4.0);
  handover.settle(after(4.0), {again, other});
  EXPECT_EQ(handover.priority(again), 0.0);
  EXPECT_GT(handover.priority(other), 0.0);
  const Track third = track_of(4, true, kPlace, 5.0);
  handover.settle(after(5.0), {again, other, third});
  EXPECT_GT(handover.priority(third), 0.0) << "the decision has passed on once";
}

TEST_F(TheHandoverPolicy, AWordIsRememberedForSomeTime) {
  for (const bool word : {false, true}) {
    HandoverPolicy handover({.mode = word ? HandoverMode::kPropose : HandoverMode::kAutomatic,
                             .seek_s = 0.0,
                             .remember_s = 8.0});
    for (const double away_s : {7.0, 9.0}) {
      handover.clear();
      handover.settle(kStart, {track_of(1, true)});
      handover.order(1, word);
      handover.settle(after(away_s), {});
      const Track again = track_of(2, true, kPlace, away_s + 0.5);
      handover.settle(after(away_s + 0.5), {again});
      EXPECT_EQ(handover.priority(again) > 0.0, (away_s < 8.0) == word) << word << " " << away_s;
    }
  }
}

}  // namespace
}  // namespace ols::fusion
