#include "central/filter/station_bias.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using namespace test;

// A filter on a flight past four stations that state a bias.
TrackFilter flown(double bias_rad) {
  TrackFilter filter(
      {}, kStart,
      {.p_ecef = site().to_ecef(path(0.0)), .position_sd_m = 100.0, .velocity_sd_m_s = 30.0});
  BiasModel errors;
  for (BearingMeasurement measurement : flight(3.0, 1e-4)) {
    measurement.sight.covariance_systematic = bias_rad * bias_rad * Eigen::Matrix2d::Identity();
    feed(filter, measurement, errors);
  }
  return filter;
}

TEST(StationBias, IsAsUnsureAsStatedAtMost) {
  const TrackFilter filter = flown(1e-3);
  for (std::size_t i = 0; i < filter.stations().size(); ++i) {
    const StationBias bias = filter.bias(i);
    EXPECT_NEAR(std::sqrt(bias.prior_rad2(0, 0)), 1e-3, 2e-4);
    EXPECT_LE(bias.covariance_rad2(0, 0), 1.1 * bias.prior_rad2(0, 0));
    EXPECT_GT(bias.covariance_rad2(0, 0), 0.0);
  }
}

TEST(StationBias, ItsPartOfTheCovarianceIsAPart) {
  const TrackFilter filter = flown(1e-3);
  const Eigen::Matrix3d all = filter.summary().covariance.topLeftCorner<3, 3>();
  const SystematicPart part = filter.systematic();
  EXPECT_GT(part.all_m2.trace(), 0.5 * all.trace());
  EXPECT_LE(part.all_m2.trace(), all.trace());
  EXPECT_LE(part.empirical_m2.trace(), part.all_m2.trace());
  EXPECT_LT(flown(1e-5).systematic().all_m2.trace(), 0.1 * part.all_m2.trace());
}

TEST(StationBias, WithoutStationsThereIsNone) {
  EXPECT_EQ(systematic_part(Eigen::MatrixXd::Identity(9, 9), {}).all_m2.trace(), 0.0);
}

}  // namespace
}  // namespace ols::fusion
