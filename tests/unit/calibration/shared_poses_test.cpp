#include "calibration/shared_poses.h"

#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

Observation star(double pan_counts, std::int64_t utime_us) {
  Observation one;
  one.kind = Kind::kStar;
  one.reading.pan.counts = pan_counts;
  one.utime_us = utime_us;
  return one;
}

TEST(SharedPoses, SightingsWithOneNumberShareAStop) {
  std::vector<Observation> observations(4, star(100.0, 1));
  observations[0].pose = observations[2].pose = 7;
  observations[1].pose = 8;
  observations[3].pose = 7;
  observations[3].station = 1;
  const SharedPoses poses(observations);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses.station(0), 0U);
  EXPECT_EQ(poses.of(0), poses.of(2));
  EXPECT_TRUE(poses.of(0).has_value());
  EXPECT_FALSE(poses.of(1).has_value());
  EXPECT_FALSE(poses.of(3).has_value());
}

// Twelve stars of one picture are not twelve stops, also where nobody has numbered them.
TEST(SharedPoses, WithoutANumberTheyAreOfOnePictureIfTimeAndCountsAreTheSame) {
  std::vector<Observation> observations{star(100.0, 5), star(100.0, 5), star(100.0, 6),
                                        star(101.0, 5), star(100.0, 0), star(100.0, 0)};
  observations.push_back(star(100.0, 5));
  observations.back().reading.pan.approach = -1;
  const SharedPoses poses(observations);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses.of(0), 0U);
  EXPECT_EQ(poses.of(1), 0U);
  for (std::size_t i = 2; i < observations.size(); ++i) EXPECT_FALSE(poses.of(i)) << i;
}

TEST(SharedPoses, ANumberThatStandsAtTwoPlacesIsRefused) {
  std::vector<Observation> observations{star(1.0, 1), star(1.0, 1), star(2.0, 1)};
  for (Observation& one : observations) one.pose = 3;
  try {
    const SharedPoses poses(observations);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_EQ(refused.index(), 2U);
    EXPECT_EQ(refused.other(), 0U);
  }
}

// Their matrices would need gigabytes.
TEST(SharedPoses, TooManyAreRefusedByTheFirstOneThatIsTooMany) {
  std::vector<Observation> observations;
  for (std::size_t i = 0; i <= kMostSharedPoses; ++i) {
    for (int k = 0; k < 2; ++k) {
      observations.push_back(star(100.0, 1));
      observations.back().pose = static_cast<std::int64_t>(i);
    }
  }
  try {
    const SharedPoses poses(observations);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_EQ(refused.index(), 2 * kMostSharedPoses);
  }
  observations.resize(2 * kMostSharedPoses);
  EXPECT_EQ(SharedPoses(observations).size(), kMostSharedPoses);
}

}  // namespace
}  // namespace ols::calibration
