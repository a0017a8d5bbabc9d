#include "central/handover/station_allocation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::site;

AllocatedTarget target_at(std::int64_t id, const Vector3d& p_enu, double priority = 1.0) {
  return {id, site().to_ecef(p_enu), priority};
}

// Looks at `at_enu`.
AllocatedStation station_at(const std::string& name, const Vector3d& p_enu,
                            const Vector3d& at_enu = {0, 1000, 50}) {
  AllocatedStation station;
  station.name = name;
  station.camera_ecef = site().to_ecef(p_enu);
  station.axis = azimuth_elevation_from_enu(R_ecef_enu(station.camera_ecef).transpose() *
                                            (site().to_ecef(at_enu) - station.camera_ecef));
  return station;
}

AllocatedStation seeing(AllocatedStation station, std::int64_t target, bool by_detector) {
  station.sees = target;
  station.by_detector = by_detector;
  return station;
}

const Vector3d kLeft(-200, 400, 60), kRight(200, 400, 60);

Allocation run(const std::vector<AllocatedTarget>& targets,
               const std::vector<AllocatedStation>& stations) {
  return allocate(targets, stations, {});
}

int led_to(const Allocation& allocation, std::int64_t target) {
  return static_cast<int>(
      std::ranges::count(allocation, target, [](const auto& one) { return one.second; }));
}

TEST(StationAllocation, EachTargetGetsTwoStationsBeforeAnyGetsAThird) {
  const std::vector<AllocatedTarget> targets = {target_at(1, kLeft, 10.0), target_at(2, kRight)};
  const auto four = run(targets, {station_at("a", {-300, 0, 0}), station_at("b", {-100, 0, 0}),
                                  station_at("c", {100, 0, 0}), station_at("d", {300, 0, 0})});
  EXPECT_EQ(led_to(four, 1), 2);
  EXPECT_EQ(led_to(four, 2), 2);
  const auto three = run(targets, {station_at("a", {-300, 0, 0}), station_at("b", {-100, 0, 0}),
                                   station_at("c", {100, 0, 0})});
  EXPECT_EQ(led_to(three, 1), 2) << "the higher priority first";
  EXPECT_EQ(led_to(three, 2), 1);
}

TEST(StationAllocation, TheTwoSeeItUnderAGoodAngle) {
  // b looks at the target already, but stands behind a.
  const auto allocation =
      run({target_at(1, kLeft), target_at(2, {-200, 4000, 60}, 1e-3)},
          {seeing(station_at("a", {-200, 0, 0}), 1, false), station_at("b", {-200, -50, 0}, kLeft),
           station_at("c", {300, 300, 0})});
  EXPECT_EQ(allocation.at("c"), 1);
  EXPECT_EQ(allocation.at("b"), 2);
}

TEST(StationAllocation, TheStationThatIsThereSoonestGoes) {
  const auto allocation =
      run({target_at(1, kLeft), target_at(2, kRight)},
          {station_at("a", {-10, 0, 0}, kRight), station_at("b", {10, 0, 0}, kLeft)});
  EXPECT_EQ(allocation.at("a"), 2);
  EXPECT_EQ(allocation.at("b"), 1);
}

TEST(StationAllocation, WhatIsBeyondTwoTrackersIsLentButNotAnOperatorsTrackers) {
  const auto stations_on_first = [](bool keeps_trackers, double priority, bool designated = false) {
    AllocatedTarget first = target_at(1, kLeft);
    first.keeps_trackers = keeps_trackers;
    std::vector<AllocatedStation> stations{seeing(station_at("a", {-300, 0, 0}), 1, false),
                                           seeing(station_at("b", {-100, 0, 0}), 1, false),
                                           seeing(station_at("c", {100, 0, 0}), 1, false)};
    for (AllocatedStation& station : stations) station.keeps_tracker = designated;
    return led_to(run({first, target_at(2, kRight, priority)}, stations), 1);
  };
  EXPECT_EQ(stations_on_first(false, 100.0, true), 3) << "an operator has started each tracker";
  EXPECT_EQ(stations_on_first(true, 100.0), 3);
  EXPECT_EQ(stations_on_first(false, 1.0), 2);
  EXPECT_EQ(stations_on_first(false, 1.3), 2) << "its two stay";
}

// No two lines to it cross at 20 degrees.
TEST(StationAllocation, ADistantTargetIsServedByTheBestPairThatThereIs) {
  const std::vector<AllocatedStation> stations = {seeing(station_at("a", {-100, 0, 0}), 1, false),
                                                  seeing(station_at("b", {-90, 0, 0}), 1, false),
                                                  seeing(station_at("c", {100, 0, 0}), 1, false)};
  const auto allocation = run({target_at(1, {0, 3000, 60}), target_at(2, kRight)}, stations);
  EXPECT_EQ(led_to(allocation, 1), 2);
  EXPECT_EQ(allocation.at("c"), 1) << "a and b alone see it under a much smaller angle";
}

// 1: a crow that is not named yet. All are at it when 2 appears, which the overview sees as well.
TEST(StationAllocation, TheSurplusGoesWhereThePriorityIsHigher) {
  AllocatedStation overview = seeing(station_at("o", {0, -300, 0}), 2, true);
  overview.is_led = false;
  const std::vector<AllocatedStation> stations = {overview,
                                                  seeing(station_at("a", {-300, 0, 0}), 1, false),
                                                  seeing(station_at("b", {-300, 800, 0}), 1, false),
                                                  seeing(station_at("c", {300, 800, 0}), 1, false),
                                                  seeing(station_at("d", {300, 0, 0}), 2, false)};
  EXPECT_EQ(led_to(run({target_at(1, kLeft), target_at(2, kRight)}, stations), 2), 1)
      << "a little gain takes no station";
  EXPECT_EQ(led_to(run({target_at(1, kLeft, 0.3), target_at(2, kRight)}, stations), 2), 2);
}

TEST(StationAllocation, OneStationSearchesTheLineWhileTargetsHaveTheOthers) {
  std::vector<AllocatedStation> stations = {seeing(station_at("a", {-300, 0, 0}, kRight), 1, false),
                                            seeing(station_at("b", {0, 0, 0}, kLeft), 1, false),
                                            seeing(station_at("c", {300, 0, 0}, kLeft), 1, false)};
  const std::vector<AllocatedTarget> targets = {target_at(1, kLeft)};
  const Vector3d line = site().to_ecef(kRight);
  const auto searcher = [&] {
    std::string name;
    for (const auto& [station, target] : allocate(targets, stations, {}, line)) {
      if (target == kOnLine) name += station;
    }
    return name;
  };
  EXPECT_EQ(searcher(), "a") << "it is there soonest";
  stations[0].may_search = false;
  EXPECT_EQ(searcher(), "c") << "a sees the object itself";
  stations[1].searches = true;
  EXPECT_EQ(searcher(), "b") << "it has begun";
  stations.erase(stations.begin() + 1);
  EXPECT_EQ(searcher(), "") << "two stay";
  stations.push_back(station_at("d", {0, 100, 0}));
  EXPECT_EQ(searcher(), "d") << "it has no target";
  stations.back().is_busy = true;
  EXPECT_EQ(searcher(), "") << "its tracker follows something of its own";
  EXPECT_TRUE(allocate({}, stations, {}, line).empty()) << "then all search";
}

TEST(StationAllocation, WhatADetectorSeesIsLeftToTwoGoodOnes) {
  const std::vector<AllocatedTarget> targets = {target_at(1, kLeft), target_at(2, kRight)};
  const auto three = run(targets, {seeing(station_at("a", {-300, 0, 0}), 1, true),
                                   seeing(station_at("b", {0, 0, 0}), 1, true),
                                   seeing(station_at("c", {100, 0, 0}), 1, true)});
  EXPECT_EQ(led_to(three, 1), 2);
  EXPECT_EQ(led_to(three, 2), 1);
  const auto two = run(targets, {seeing(station_at("a", {-300, 0, 0}), 1, true),
                                 seeing(station_at("b", {100, 0, 0}), 1, true)});
  EXPECT_EQ(led_to(two, 1), 2);
}

// A station that stares sees a target; it is not led, but one more is enough.
TEST(StationAllocation, AStaringStationCountsAndIsNotLed) {
  AllocatedStation overview = seeing(station_at("o", {-300, 0, 0}), 1, true);
  overview.is_led = false;
  const auto allocation = run({target_at(1, kLeft), target_at(2, kRight)},
                              {overview, station_at("a", {100, 0, 0}, kLeft),
                               station_at("b", {-100, 0, 0}), station_at("c", {300, 0, 0})});
  EXPECT_FALSE(allocation.contains("o"));
  EXPECT_EQ(led_to(allocation, 1), 1);
  EXPECT_EQ(led_to(allocation, 2), 2);
}

TEST(StationAllocation, ALittleGainTakesNoStation) {
  AllocatedStation a = station_at("a", {0, 0, 0}, kRight);
  a.led_to = 1;
  const auto towards = [&](double priority) {
    return run({target_at(1, {-1, 400, 60}), target_at(2, {1, 400, 60}, priority)}, {a}).at("a");
  };
  EXPECT_EQ(towards(1.3), 1);
  EXPECT_EQ(towards(100.0), 2);
}

// 1 has its two stations, which may both be on their way to somewhere else; 2 has none.
TEST(StationAllocation, OnlyWhatIsWorthMoreTakesTheTwoStationsOfATarget) {
  std::vector<AllocatedStation> stations{seeing(station_at("a", {-300, 0, 0}), 1, false),
                                         seeing(station_at("b", {100, 0, 0}), 1, false)};
  const auto at_second = [&](double priority) {
    return led_to(run({target_at(1, kLeft), target_at(2, kRight, priority)}, stations), 2);
  };
  EXPECT_EQ(at_second(1.3), 0) << "a little more";
  EXPECT_EQ(at_second(10.0), 2) << "an operator's";
  for (AllocatedStation& station : stations) station.led_to = 2;
  EXPECT_EQ(at_second(1.0), 0) << "the target has lost a third station meanwhile";
  stations.push_back(seeing(station_at("c", {300, 0, 0}), 3, false));
  stations.push_back(seeing(station_at("d", {300, 800, 0}), 3, false));
  const auto three =
      run({target_at(1, kLeft, 5.0), target_at(2, kRight, 10.0), target_at(3, {200, 500, 60})},
          stations);
  EXPECT_EQ(led_to(three, 1), 2) << "it takes from the third what the second has taken from it";
  EXPECT_EQ(led_to(three, 2), 2);
}

TEST(StationAllocation, WhatHasBeenTakenDoesNotGoBackOnItsWay) {
  std::vector<AllocatedStation> stations{seeing(station_at("a", {-300, 0, 0}, kLeft), 1, false),
                                         seeing(station_at("b", {100, 0, 0}, kLeft), 1, false)};
  const std::vector<AllocatedTarget> targets = {target_at(1, kLeft), target_at(2, kRight, 1.8)};
  ASSERT_EQ(led_to(run(targets, stations), 2), 2);
  for (AllocatedStation& station : stations) {  // their cameras still look at the first
    station.sees = 0;
    station.led_to = 2;
  }
  EXPECT_EQ(led_to(run(targets, stations), 2), 2);
}

TEST(StationAllocation, TheTwoAreTakenOnlyIfNoOtherStationsHelp) {
  const auto allocation = run({target_at(1, kLeft), target_at(2, kRight, 1.8)},
                              {seeing(station_at("a", {-300, 0, 0}, kRight), 1, false),
                               seeing(station_at("b", {100, 0, 0}, kRight), 1, false),
                               station_at("c", {-300, 800, 0}, {0, -1000, 50}),
                               station_at("d", {300, 800, 0}, {0, -1000, 50})});
  EXPECT_EQ(allocation.at("a"), 1);
  EXPECT_EQ(allocation.at("b"), 1);
}

// c has been lent to find 2, was sent back to 1 when it had found it, and sees 2 now.
TEST(StationAllocation, WhoIsOnTheWayToATargetIsNoneOfItsTwo) {
  std::vector<AllocatedStation> stations{seeing(station_at("a", {-300, 0, 0}, kLeft), 1, false),
                                         seeing(station_at("b", {300, 0, 0}, kLeft), 1, false),
                                         seeing(station_at("c", {300, 800, 0}), 2, false)};
  stations[2].led_to = 1;
  const auto both = run({target_at(1, kLeft), target_at(2, kRight, 0.3)}, stations);
  EXPECT_EQ(both.at("c"), 2) << "it sees that one, and nobody else does";
  EXPECT_EQ(led_to(both, 1), 2);
  // a and b see it under a small angle only; c comes to help, and is not there yet.
  const auto helped = run(
      {target_at(1, kLeft), target_at(2, kRight, 0.5)},
      {seeing(station_at("a", {-200, 0, 0}), 1, false),
       seeing(station_at("b", {-200, -50, 0}, kLeft), 1, false), station_at("c", {300, 300, 0})});
  EXPECT_EQ(led_to(helped, 1), 3);
}

TEST(StationAllocation, WhoIsLeftGoesWhereTheFewestAre) {
  const auto allocation = run(
      {target_at(1, kLeft), target_at(2, kRight)},
      {seeing(station_at("a", {-300, 0, 0}), 1, false),
       seeing(station_at("b", {0, 0, 0}), 1, false), seeing(station_at("c", {100, 0, 0}), 1, false),
       seeing(station_at("d", {0, 100, 0}), 2, false),
       seeing(station_at("e", {400, 0, 0}), 2, false), station_at("f", {0, 10, 0}, kLeft)});
  EXPECT_EQ(allocation.at("f"), 2);
}

TEST(StationAllocation, WithoutTargetsThereIsNone) {
  EXPECT_TRUE(run({}, {station_at("a", {0, 0, 0})}).empty());
}

}  // namespace
}  // namespace ols::fusion
