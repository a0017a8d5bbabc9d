#include "central/tracking/unassociated_bearings.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using namespace test;

BearingMeasurement at(double t_s) {
  return measurement_of(ray_to("a", {0, 0, 0}, path(t_s)), kStart + std::llround(t_s * 1e6));
}

TEST(UnassociatedBearings, AreInOrderOfTimeAndNotOld) {
  UnassociatedBearings pool(0.5, 100);
  for (const double t_s : {0.0, 0.4, 0.2, 0.6}) pool.store(at(t_s));
  const auto& own = pool.stations().at("a");
  ASSERT_EQ(own.bearings.size(), 3U);
  ASSERT_EQ(own.looks.size(), 3U);
  EXPECT_EQ(own.bearings.front().utime_us, kStart + 200'000);
  EXPECT_EQ(own.looks.back().utime_us, kStart + 600'000);
}

TEST(UnassociatedBearings, AreNoMoreThanTheMost) {
  UnassociatedBearings pool(10.0, 4);
  for (int i = 0; i < 20; ++i) pool.store(at(0.01 * i));
  EXPECT_EQ(pool.stations().at("a").bearings.size(), 4U);
}

TEST(UnassociatedBearings, AStationWithoutAnyIsNotThere) {
  UnassociatedBearings pool(10.0, 4);
  pool.store(at(0.0));
  pool.erase_if("a", [](const BearingMeasurement&) { return true; });
  EXPECT_TRUE(pool.stations().empty());
}

TEST(UnassociatedBearings, ALookIsNearWhereItPoints) {
  UnassociatedBearings pool(10.0, 4);
  pool.store(at(0.0));
  const BearingSummary& look = pool.stations().at("a").looks.front();
  EXPECT_TRUE(look.is_near(site().to_ecef(path(0.0)), 0.0));
  EXPECT_FALSE(look.is_near(site().to_ecef(path(0.0) + Eigen::Vector3d(200, 0, 0)), 0.0));
}

}  // namespace
}  // namespace ols::fusion
