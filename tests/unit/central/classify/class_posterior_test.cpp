#include "central/classify/class_posterior.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::fusion {
namespace {

// A quarter of a second apart, each alike.
ClassPosterior after(double seconds, const ClassLook& look) {
  ClassPosterior posterior;
  for (int i = 0; i <= 4 * seconds; ++i) posterior.add(1 + i * 250'000LL, look);
  return posterior;
}

ClassLook look(double size_m, double speed_m_s, double climb_m_s, double flicker) {
  return {.size_m = {size_m, 0.1 * size_m},
          .speed_m_s = {speed_m_s, 0.3},
          .climb_m_s = {climb_m_s, 0.3},
          .across_m_s2 = {0.5, 0.5},
          .flicker = {flicker, 0.003}};
}

TEST(ClassPosterior, NamesWhatIsPlain) {
  struct Case {
    ClassLook look;
    ObjectClass expected;
  };
  for (const auto& [seen, expected] : {Case{look(0.5, 0.2, 4.0, 0.0), ObjectClass::kDrone},
                                       Case{look(0.8, 12.0, 0.0, 0.04), ObjectClass::kBird},
                                       Case{look(35.0, 120.0, 5.0, 0.0), ObjectClass::kAircraft},
                                       Case{look(400.0, 30e3, -10e3, 0.0), ObjectClass::kOther}}) {
    const ClassBelief belief = after(10.0, seen).belief();
    EXPECT_EQ(belief.object_class, expected) << seen.size_m.value;
    EXPECT_GE(belief.probability, kSure);
  }
}

TEST(ClassPosterior, IsUnknownAtFirstByVagueLooksWithoutSizeAndBetweenTwoClasses) {
  const ClassLook drone = look(0.5, 0.2, 4.0, 0.0);
  EXPECT_EQ(after(0.75, drone).belief().object_class, ObjectClass::kUnknown);
  const ClassLook vague{{0.5, 5.0},  {0.2, 30.0},   {4.0, 30.0},
                        {0.5, 50.0}, {50.0, 300.0}, {0.0, 0.3}};
  EXPECT_EQ(after(10.0, vague).belief().object_class, ObjectClass::kUnknown);
  ClassLook sizeless = drone;
  sizeless.size_m = {};
  EXPECT_EQ(after(10.0, sizeless).belief().object_class, ObjectClass::kUnknown);
  ClassLook gliding = look(0.8, 8.5, 0.0, 0.0);  // a drone, or a bird whose beat is not seen
  gliding.flicker = {};
  const ClassBelief doubtful = after(10.0, gliding).belief();
  EXPECT_EQ(doubtful.object_class, ObjectClass::kUnknown);
  EXPECT_EQ(doubtful.probability, 0.0);
}

TEST(ClassPosterior, MoreLooksInTheSameTimeSayNoMore) {
  ClassLook seen = look(0.8, 8.5, 0.0, 0.0);
  seen.flicker = {};
  ClassPosterior often;
  for (int i = 0; i <= 400; ++i) often.add(1 + i * 10'000LL, seen);
  const auto seldom = after(4.0, seen).posterior();
  for (int i = 0; i < kObjectClasses; ++i) EXPECT_NEAR(often.posterior()[i], seldom[i], 1e-9);
}

TEST(ClassPosterior, WhatAnObjectKeepsForItsLifeCountsOnce) {
  ClassLook lasting = look(0.8, 12.0, 0.0, 0.0);
  lasting.climb_m_s = lasting.across_m_s2 = lasting.flicker = {};
  const auto early = after(2.0, lasting).posterior(), late = after(16.0, lasting).posterior();
  for (int i = 0; i < kObjectClasses; ++i) EXPECT_NEAR(early[i], late[i], 1e-9);
}

TEST(ClassPosterior, FlickerIsWhatTheNoiseDoesNotExplain) {
  std::vector<SeenSize> beating, steady, from_the_side;
  for (int i = 0; i < 20; ++i) {
    const double at_s = 0.05 * i;
    beating.push_back({1.0 + 0.3 * std::sin(2.0 * i), 0.25, 0.05, 0.0, at_s});
    from_the_side.push_back({1.0, 0.25, 0.05, 0.5 + 0.15 * std::sin(2.0 * i), at_s});
    steady.push_back({i % 2 == 0 ? 1.05 : 0.95, 0.25, 0.05, i % 2 == 0 ? 0.475 : 0.525, at_s});
  }
  EXPECT_NEAR(look_at({beating}, {}, {}, 0.0, 1.0).flicker.value, 0.045 - 0.0025, 0.005);
  EXPECT_NEAR(look_at({steady}, {}, {}, 0.0, 1.0).flicker.value, 0.0, 0.001);
  EXPECT_NEAR(look_at({from_the_side}, {}, {}, 0.0, 1.0).flicker.value, 0.045 - 0.005, 0.005);
  EXPECT_NEAR(look_at({steady}, {}, {}, 0.0, 1.0).size_m.sd, 0.25, 1e-9);
  const double before = look_at({beating}, {}, {}, 0.0, 1.0).flicker.value;
  beating.push_back({2.0, 0.25, 0.0, 0.0, 1.0});
  EXPECT_EQ(look_at({beating}, {}, {}, 0.0, 1.0).flicker.value, before) << "of unknown noise";
}

TEST(ClassPosterior, FlickerIsOfTheStationWithTheLeastNoiseOfOutlines) {
  StationSizes beating, noisy, without_outlines;
  for (int i = 0; i < 5; ++i) {
    const double size_m = 1.0 + 0.3 * std::sin(2.0 * i);
    beating.push_back({size_m, 0.25, 0.01, 0.0, 0.2 * i});
    noisy.push_back({1.0, 0.2, 0.2, 0.0, 0.2 * i});
    without_outlines.push_back({1.2, 0.1, 0.0, 0.0, 0.2 * i});
  }
  const double flicker = look_at({beating}, {}, {}, 0.0, 1.0).flicker.value;
  const ClassLook look = look_at({noisy, beating, without_outlines}, {}, {}, 0.0, 1.0);
  EXPECT_GT(flicker, 0.03);
  EXPECT_EQ(look.flicker.value, flicker);
  EXPECT_NEAR(look.size_m.value, 1.2, 1e-9) << "of the station whose size is the most certain";
  StationSizes few(beating.begin(), beating.end() - 1), within_less = beating;
  for (SeenSize& one : within_less) one.time_s *= 0.5;
  for (const StationSizes& sizes : {few, within_less})
    EXPECT_EQ(look_at({sizes}, {}, {}, 0.0, 1.0).flicker.sd, 0.0);
}

TEST(ClassPosterior, LooksWithoutAFlickerTakeNoWeightFromThoseWithOne) {
  const ClassLook known = look(0.8, 8.5, 0.0, 0.0);
  ClassLook unknown = known;
  unknown.flicker = {};
  ClassPosterior seldom;
  for (int i = 0; i <= 40; ++i) seldom.add(1 + i * 250'000LL, i % 8 == 0 ? known : unknown);
  const auto always = after(10.0, known).posterior();
  EXPECT_GT(always[static_cast<int>(ObjectClass::kDrone)], kSure);
  for (int i = 0; i < kObjectClasses; ++i) EXPECT_NEAR(seldom.posterior()[i], always[i], 1e-9);
}

TEST(ClassPosterior, AFlickerThatIsNoLongerSeenIsForgotten) {
  const ClassLook flapping = look(0.8, 8.5, 0.0, 0.08);
  ClassLook unknown = flapping;
  unknown.flicker = {};
  ClassPosterior posterior = after(10.0, flapping);
  ASSERT_EQ(posterior.belief().object_class, ObjectClass::kBird);
  for (int i = 1; i <= 800; ++i) posterior.add(10'000'001 + i * 250'000LL, unknown);
  const auto never = after(200.0, unknown).posterior();
  for (int i = 0; i < kObjectClasses; ++i) EXPECT_NEAR(posterior.posterior()[i], never[i], 0.01);
}

TEST(ClassPosterior, AFlickerThatIsSeenAgainAfterALongTimeCountsOnce) {
  const ClassLook still = look(0.8, 8.5, 0.0, 0.0);
  ClassLook unknown = still;
  unknown.flicker = {};
  ClassPosterior again, once;
  again.add(1, still);
  once.add(1, unknown);
  for (int i = 1; i < 400; ++i)
    for (ClassPosterior* one : {&again, &once}) one->add(1 + i * 250'000LL, unknown);
  for (ClassPosterior* one : {&again, &once}) one->add(100'000'001, still);
  for (int i = 0; i < kObjectClasses; ++i)
    EXPECT_NEAR(again.posterior()[i], once.posterior()[i], 0.02);
}

TEST(ClassPosterior, AStrayLookMakesNoBirdOfADrone) {
  ClassLook drone = look(0.5, 0.2, 4.0, 0.0005), stray = drone;
  drone.flicker.sd = stray.flicker.sd = 1e-4;
  stray.flicker.value = 0.12;
  ClassPosterior posterior = after(10.0, drone);
  posterior.add(10'300'000, stray);
  EXPECT_EQ(posterior.belief().object_class, ObjectClass::kDrone);
}

TEST(ClassPosterior, MotionIsSplitByItsPath) {
  const ClassLook turning = look_at({}, {3.0, 4.0, 2.0}, {4.0, 4.0, 2.0}, 0.5, 0.1);
  EXPECT_NEAR(turning.speed_m_s.value, 5.0, 1e-9);
  EXPECT_NEAR(turning.climb_m_s.value, 2.0, 1e-9);
  EXPECT_NEAR(turning.across_m_s2.value, 2.0 * std::sqrt(1.0 - 9.0 / 29.0), 1e-6);
  EXPECT_EQ(turning.size_m.sd, 0.0);
}

}  // namespace
}  // namespace ols::fusion
