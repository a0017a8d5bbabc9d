#include "central/estimators/estimator.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::feed;
using test::flight;
using test::kStart;
using test::path;
using test::site;

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

}  // namespace
}  // namespace ols::fusion
