#include "central/estimators/estimator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::feed;
using test::flight;
using test::kStart;
using test::path;
using test::site;
using test::square;

TEST(Estimator, TheStationsOfATargetAreThoseWhoseBearingsItUses) {
  BiasModel errors;
  TrackFilter filter(
      {}, kStart,
      {.p_ecef = site().to_ecef(path(0.0)), .position_sd_m = 100.0, .velocity_sd_m_s = 50.0});
  for (const BearingMeasurement& bearing : flight(1.0, 1e-4, 1e-4)) feed(filter, bearing, errors);
  const auto stations = contributing(filter, filter.utime_us());
  ASSERT_EQ(stations.size(), 4U);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    EXPECT_EQ(stations[i].station, std::string(1, static_cast<char>('a' + i)));
    EXPECT_TRUE(stations[i].used) << i;
    EXPECT_GT(stations[i].weight, 0.0) << i;
    EXPECT_NEAR(stations[i].age_s, static_cast<double>(3 - i) / 60.0, 1e-5) << i;
  }
  EXPECT_TRUE(contributing(filter, filter.utime_us() + 60'000'000).empty());
}

TEST(Estimator, TheFilterTellsTheGreatestCrossingAngleOfItsStations) {
  BiasModel errors;
  TrackFilter filter(
      {}, kStart,
      {.p_ecef = site().to_ecef(path(0.0)), .position_sd_m = 100.0, .velocity_sd_m_s = 50.0});
  for (const BearingMeasurement& bearing : flight(1.0, 1e-4, 1e-4)) feed(filter, bearing, errors);
  const double t_s = static_cast<double>(filter.utime_us() - kStart) * 1e-6;
  double greatest_rad = 0.0;
  for (const Eigen::Vector3d& a : square()) {
    for (const Eigen::Vector3d& b : square()) {
      const Eigen::Vector3d to = path(t_s) - a, from = path(t_s) - b;
      const double between_lines = std::atan2(to.cross(from).norm(), std::abs(to.dot(from)));
      greatest_rad = std::max(greatest_rad, between_lines);
    }
  }
  const StationBearings bearings;
  const Located located =
      make_estimator("filter", {})->locate({bearings, errors, &filter}, filter.utime_us());
  ASSERT_EQ(located.estimate.solution, Solution::kOk);
  EXPECT_NEAR(located.estimate.crossing_angle_rad, greatest_rad, 0.01);
}

}  // namespace
}  // namespace ols::fusion
