#include "central/tracking/target_appearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

const Eigen::Vector3d kThere_enu{0.0, 0.0, 100.0};

// Seen by a station 100 m and one 200 m below it.
Track seen_by_two(const Sighted& near, const Sighted& far) {
  Track track(TrackFilter({}, 1, {.p_ecef = test::site().to_ecef(kThere_enu)}));
  const auto add = [&](const std::string& station, double up_m, const Sighted& seen) {
    BearingMeasurement m =
        test::measurement_of(test::ray_to(station, {0.0, 0.0, up_m}, kThere_enu), 1);
    m.sighted = seen;
    track.bearings[station].push_back(m);
  };
  add("near", 0.0, near);
  add("far", -100.0, far);
  return track;
}

Appearance appearance(const Sighted& near, const Sighted& far) {
  return appearance_of(seen_by_two(near, far), test::site().to_ecef(kThere_enu));
}

TEST(TargetAppearance, SizesWeighByTheirVarianceInMetres) {
  // 1 m +- 0.1 m, and 2 m +- 0.2 m.
  const Appearance seen = appearance({.size_rad = 0.01, .size_sd_rad = 0.001, .signal = 5.0},
                                     {.size_rad = 0.01, .size_sd_rad = 0.001, .signal = 9.0});
  EXPECT_NEAR(seen.size_m, (1.0 * 100.0 + 2.0 * 25.0) / 125.0, 1e-6);
  EXPECT_NEAR(seen.size_sd_m, 1.0 / std::sqrt(125.0), 1e-7);
  EXPECT_EQ(seen.signal, 9.0);
  EXPECT_EQ(seen.object_class, ObjectClass::kUnknown);
}

TEST(TargetAppearance, ClassesOfBothStationsMultiply) {
  const Appearance seen = appearance({.class_probability = {0.0, 0.6, 0.4, 0.0, 0.0}},
                                     {.class_probability = {0.0, 0.2, 0.8, 0.0, 0.0}});
  EXPECT_EQ(seen.object_class, ObjectClass::kBird);
  EXPECT_NEAR(seen.class_probability, 0.32 / (0.32 + 0.12), 1e-4);
}

TEST(TargetAppearance, NothingSeenIsUnknown) {
  const Appearance seen = appearance({}, {});
  EXPECT_EQ(seen.size_m, 0.0);
  EXPECT_EQ(seen.size_sd_m, 0.0);
  EXPECT_EQ(seen.class_probability, 0.0);
}

}  // namespace
}  // namespace ols::fusion
