#include "calibration/procedure/sighting_planner.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

class SightingPlannerTest : public testing::Test {
 protected:
  SightingPlannerTest() {
    for (const auto& [name, reference] : all.references) {
      const auto& point = std::get<FixedPoint>(reference);
      places.push_back({name, point.ecef, point.sd_m});
    }
  }
  std::vector<Foretold> rank(std::vector<Observation> observed, int times = 2) {
    SightingPlanner planner(
        all, [observed] { return observed; }, times);
    return planner.rank(test::hill(), places);
  }
  double of(const std::vector<Foretold>& ranked, const std::string& name) {
    for (const Foretold& one : ranked) {
      if (one.name == name) return one.rms_rad;
    }
    return 0.0;
  }

  Problem all = test::landmarks_around(test::hill(), test::hill(), 9);
  std::vector<Place> places;
};

TEST_F(SightingPlannerTest, ThePlaceAcrossTheHorizonHelpsMoreThanOneBeside) {
  std::vector<Observation> observed(all.observations.begin(), all.observations.begin() + 4);
  const auto ranked = rank(observed);
  ASSERT_EQ(ranked.size(), 9U);
  EXPECT_LT(of(ranked, "landmark7"), 0.8 * of(ranked, "landmark1"));
  for (std::size_t i = 1; i < ranked.size(); ++i) {
    EXPECT_LE(ranked[i - 1].rms_rad, ranked[i].rms_rad);
  }
}

TEST_F(SightingPlannerTest, WhatWasObservedAndHowOftenOneLooksCount) {
  std::vector<Observation> few(all.observations.begin(), all.observations.begin() + 4);
  EXPECT_LT(rank(all.observations).front().rms_rad, 0.8 * rank(few).front().rms_rad);
  EXPECT_LT(rank(few, 6).front().rms_rad, rank(few, 1).front().rms_rad);
}

TEST_F(SightingPlannerTest, StarsThatCannotBeIdentifiedAreLeftOut) {
  std::vector<Observation> observed(all.observations.begin(), all.observations.begin() + 4);
  const auto without = rank(observed);
  Observation star = observed[0];
  star.kind = Kind::kStar;
  star.reference.clear();
  star.utime_us = 1'780'000'000'000'000;
  observed.push_back(star);
  const auto with = rank(observed);
  ASSERT_EQ(with.size(), without.size());
  EXPECT_EQ(with.front().rms_rad, without.front().rms_rad);
}

TEST_F(SightingPlannerTest, InWordsWithItsFigure) {
  EXPECT_EQ(in_words({}), "");
  EXPECT_EQ(in_words({{"mast", 10.04 * test::kArcsec}}), "mast would leave 10.0″");
  EXPECT_EQ(in_words({{"mast", 10.04 * test::kArcsec}, {"barn", 12.0 * test::kArcsec}}),
            "mast would leave 10.0″ (barn 12.0″)");
}

}  // namespace
}  // namespace ols::calibration
