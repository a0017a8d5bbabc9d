#include "central/tracking/ray_meetings.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using namespace test;
using Eigen::Vector3d;

BearingMeasurement seen(const std::string& station, const Vector3d& from, const Vector3d& to) {
  return measurement_of(ray_to(station, from, to), kStart);
}

struct Met {
  std::vector<RayMeeting> meetings;
  Solution failure = Solution::kTooFewRays;
};

Met meet(const BearingMeasurement& first, const std::vector<BearingMeasurement>& others) {
  UnassociatedBearings pool(1.0, 10);
  for (const BearingMeasurement& other : others) pool.store(other);
  Met met;
  met.meetings = RayMeetings({}, 500e3).of(first, pool, BiasModel(), met.failure);
  return met;
}

const Vector3d kTarget(0, 300, 80), kWest(-200, 0, 0), kEast(200, 0, 0), kNorth(50, 600, 0);

TEST(RayMeetings, AreWhereRaysMeet) {
  const Met met = meet(seen("w", kWest, kTarget), {seen("e", kEast, kTarget)});
  ASSERT_EQ(met.meetings.size(), 1U);
  EXPECT_LT((met.meetings[0].p_ecef - site().to_ecef(kTarget)).norm(), 0.01);
  EXPECT_EQ(met.meetings[0].support, 0);
}

TEST(RayMeetings, WhereMoreStationsLookIsFirst) {
  const Vector3d ghost = kWest + 0.5 * (kTarget - kWest);
  const Met met =
      meet(seen("w", kWest, kTarget),
           {seen("a", kEast, ghost), seen("e", kEast, kTarget), seen("n", kNorth, kTarget)});
  ASSERT_GE(met.meetings.size(), 3U);
  EXPECT_LT((met.meetings[0].p_ecef - site().to_ecef(kTarget)).norm(), 0.1);
  EXPECT_EQ(met.meetings[0].support, 1);
}

TEST(RayMeetings, SayWhyThereAreNone) {
  const BearingMeasurement west = seen("w", kWest, kTarget);
  EXPECT_EQ(meet(west, {}).failure, Solution::kTooFewRays);
  EXPECT_EQ(meet(west, {seen("e", kEast, kEast + (kTarget - kWest))}).failure,
            Solution::kParallelRays);
  EXPECT_EQ(meet(west, {seen("e", kEast, 2.0 * kEast - kTarget)}).failure, Solution::kBehindCamera);
}

}  // namespace
}  // namespace ols::fusion
