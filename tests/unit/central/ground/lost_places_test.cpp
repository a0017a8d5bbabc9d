#include "central/ground/lost_places.h"

#include <gtest/gtest.h>

#include <random>

namespace ols::fusion {
namespace {

constexpr double kFar_m = 400.0;

AzimuthElevation middle_of(const LostPlaces::Cell& cell) {
  return {(cell.azimuth + 0.5) * LostPlaces::kCell_rad,
          LostPlaces::kLowest_rad + (cell.elevation + 0.5) * LostPlaces::kCell_rad};
}

int losses_until_told(LostPlaces& places, const LostPlaces::Cell& cell) {
  int losses = 0;
  while (places.places().empty() && losses < 100) {
    places.lost(cell, kFar_m);
    ++losses;
  }
  return losses;
}

// A station that hardly ever loses a target by chance. What was seen before a crane was put up
// counts for the station, but not for the cell.
TEST(LostPlaces, IsNoticedAfterFourLossesHoweverOftenTheCellWasSeenBefore) {
  LostPlaces places;
  for (int i = 0; i < 200; ++i) places.seen({i % 20, 4}, kFar_m);
  EXPECT_FALSE(places.may_hide());
  EXPECT_EQ(losses_until_told(places, {10, 4}), 4);
  EXPECT_GT(places.probability(middle_of({10, 4}), kFar_m), 0.99);
  EXPECT_EQ(places.probability(middle_of({11, 4}), kFar_m), 0.0);
  EXPECT_LT(places.probability(middle_of({10, 5}), kFar_m), 1e-3);       // above it
  EXPECT_GT(places.probability(middle_of({10, 2}), kFar_m), 0.99);       // it stands on the ground
  EXPECT_EQ(places.probability(middle_of({10, 4}), 0.5 * kFar_m), 0.0);  // before the crane
}

TEST(LostPlaces, NeedsMoreLossesFromAStationThatOftenLosesTargets) {
  LostPlaces places;
  for (int i = 0; i < 700; ++i) {
    if (i % 10 == 0) {
      places.lost({i, 9}, kFar_m);
    } else {
      places.seen({i, 9}, kFar_m);
    }
  }
  EXPECT_TRUE(places.places().empty());
  EXPECT_GT(losses_until_told(places, {10, 4}), 5);
}

TEST(LostPlaces, EndsWhenTargetsAreSeenThereAgain) {
  LostPlaces places;
  for (int i = 0; i < 100; ++i) places.seen({i, 4}, kFar_m);
  for (int i = 0; i < 50; ++i) places.lost({10, 4}, kFar_m);
  for (int i = 0; i < 20; ++i) places.seen({10, 4}, 0.5 * kFar_m);  // nearer: proves nothing
  EXPECT_EQ(places.places().size(), 1U);
  int seen = 0;
  for (; places.may_hide() && seen < 100; ++seen) places.seen({10, 4}, kFar_m);
  EXPECT_GT(seen, 2);
  EXPECT_LT(seen, 12);
}

// Targets that were lost at different elevations were behind the same mast. Where they were seen
// above it, nothing stands.
TEST(LostPlaces, AreFoundFromPassesAtDifferentElevations) {
  LostPlaces places;
  for (int i = 0; i < 300; ++i) places.seen({i, 64}, kFar_m);
  for (const int elevation : {70, 66, 68, 72}) places.lost({200, elevation}, kFar_m);
  places.seen({200, 71}, kFar_m);
  ASSERT_EQ(places.places().size(), 1U);
  EXPECT_GT(places.probability(middle_of({200, 66}), kFar_m), 0.99);
  EXPECT_LT(places.probability(middle_of({200, 71}), kFar_m), 0.1);
}

TEST(LostPlaces, TellsRegionsAlsoAcrossNorth) {
  LostPlaces places;
  for (int i = 0; i < 1000; ++i) places.seen({i % 720, 0}, kFar_m);
  for (int i = 0; i < 5; ++i) {
    for (const LostPlaces::Cell& cell :
         {LostPlaces::Cell{1439, 126}, {0, 126}, {1, 129}, {200, 116}})
      places.lost(cell, kFar_m);
  }
  const auto told = places.places();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_NEAR(told[1].from_azimuth_rad, radians(359.75), 1e-9);
  EXPECT_NEAR(told[1].to_azimuth_rad, radians(0.5), 1e-9);
  EXPECT_NEAR(told[1].from_elevation_rad, radians(1.5), 1e-9);
  EXPECT_NEAR(told[1].to_elevation_rad, radians(2.5), 1e-9);
  EXPECT_NEAR(told[0].from_azimuth_rad, radians(50.0), 1e-9);
  EXPECT_NEAR(told[0].from_elevation_rad, radians(-1.0), 1e-9);
}

// A day of flight with a cell each 0.2 s, always over the same 200 cells. Every hundred seconds the
// station loses the target for 2 s, wherever it is: ten cells in a row.
TEST(LostPlaces, AreNotTakenFromLossesByChance) {
  constexpr int kPasses = 5 * 86'400, kRow = 10, kEvery = 500;
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> any(0, kEvery - 1);
  LostPlaces places;
  int left = 0, alarms = 0;
  for (int i = 0; i < kPasses; ++i) {
    if (left == 0 && any(random) == 0) left = kRow;
    const LostPlaces::Cell cell{i % 200, 60 + i % 3};
    if (left == 0) {
      places.seen(cell, kFar_m);
    } else {
      places.lost(cell, kFar_m);
      --left;
    }
    if (left > 0) alarms += places.places().empty() ? 0 : 1;
  }
  EXPECT_EQ(alarms, 0);
}

}  // namespace
}  // namespace ols::fusion
