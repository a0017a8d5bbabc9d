// Invariance of the fusion's result: to the order of the station names, the place on the globe, and
// the scale of the scene.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "central/estimators/least_squares.h"
#include "central/offline/offline_fusion.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::flight;
using test::kStart;

class EachEstimator : public testing::TestWithParam<const char*> {};

std::vector<FusedTarget> fused(const std::vector<BearingMeasurement>& measurements,
                               const char* estimator, double scale = 1.0) {
  OfflineConfig config;
  config.estimator = estimator;
  config.rate_hz = 5.0;
  MotionConfig& motion = config.fusion.tracks.filter.motion;
  motion.acceleration_sd_m_s2 *= scale;
  motion.cruise_sd_m_s2 *= scale;
  AlignmentConfig& alignment = config.fusion.estimators.alignment;
  alignment.acceleration_sd_m_s2 *= scale;
  alignment.range_unknown_m *= scale;
  return fuse_offline(measurements, config);
}

constexpr double kSame = 1e-4;  // of the stated error: only the order of sums differs

void expect_same(const std::vector<FusedTarget>& a, const std::vector<FusedTarget>& b,
                 const Eigen::Isometry3d& moved, double same = kSame) {
  const Eigen::Matrix3d turned = moved.linear();
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 10U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Estimate &was = a[i].estimate, &is = b[i].estimate;
    ASSERT_EQ(was.solution, is.solution);
    const Vector3d there = moved * was.position_ecef;
    const bool stated = was.covariance_ecef.allFinite();
    const double sd = stated ? std::sqrt(was.covariance_ecef.trace()) : 1.0;
    EXPECT_LT((is.position_ecef - there).norm(), same * sd);
    if (!stated) continue;
    const Eigen::Matrix3d P = turned * was.covariance_ecef * turned.transpose();
    EXPECT_LT((is.covariance_ecef - P).norm(), same * P.norm());
  }
}

TEST_P(EachEstimator, DoesNotCareHowStationsAreNamed) {
  const auto before = flight(4.0, 1e-4, 1e-4);
  auto after = before;
  for (BearingMeasurement& measurement : after) {
    measurement.station = std::string(1, "dbca"[measurement.station[0] - 'a']);
  }
  expect_same(fused(before, GetParam()), fused(after, GetParam()), Eigen::Isometry3d::Identity());
}

// The ellipsoid is the same at every longitude.
TEST_P(EachEstimator, DoesNotCareWhereOnTheGlobeTheSiteLies) {
  const auto before = flight(4.0, 1e-4, 1e-4);
  for (const double turn_deg : {-16.6, 90.0, 163.4, 179.9}) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(radians(turn_deg), Vector3d::UnitZ()).toRotationMatrix();
    auto after = before;
    for (BearingMeasurement& measurement : after) {
      measurement.sight.origin_ecef = (turn * measurement.sight.origin_ecef).eval();
    }
    expect_same(fused(before, GetParam()), fused(after, GetParam()), Eigen::Isometry3d(turn));
  }
}

// It is nearly the same at every latitude, and rays in space do not depend on the horizon: the
// whole site is moved as a rigid body. The second differences of the interpolated elevations and
// azimuths depend on the horizons by some thousandths.
TEST_P(EachEstimator, DoesNotCareWhichWayUpTheSiteLies) {
  const auto before = flight(4.0, 1e-4, 1e-4);
  const LocalFrame& here = test::site();
  for (const Geodetic& place :
       {Geodetic{radians(0.0), radians(-70.0), 20.0}, Geodetic{radians(-33.0), radians(151.0), 0.0},
        Geodetic{radians(-89.0), radians(10.0), 2800.0}}) {
    const LocalFrame there(place);
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    moved.linear() = there.R_ecef_enu() * here.R_ecef_enu().transpose();
    moved.translation() = there.origin_ecef() - moved.linear() * here.origin_ecef();
    auto after = before;
    for (BearingMeasurement& measurement : after) {
      const Vector3d ray = moved.linear() * direction_ecef(measurement.sight);
      measurement.sight.origin_ecef = (moved * measurement.sight.origin_ecef).eval();
      measurement.sight.direction =
          azimuth_elevation_from_enu(R_ecef_enu(measurement.sight.origin_ecef).transpose() * ray);
    }
    expect_same(fused(before, GetParam()), fused(after, GetParam()), moved, 3e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Fusion, EachEstimator, testing::Values("filter", "least-squares", "paper"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::erase(name, '-');
                           return name;
                         });

// The same flight, scaled: angles stay, errors grow with the scale. The horizons of the stations
// turn by the Earth's curvature, so this holds to some thousandths.
std::vector<BearingMeasurement> scaled_flight(double scale) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<BearingMeasurement> measurements;
  for (int i = 0; i < 240; ++i) {
    const auto k = static_cast<std::size_t>(i % 4);
    Ray ray = test::ray_to(std::string(1, static_cast<char>('a' + i % 4)),
                           scale * test::square()[k], scale * test::path(i / 60.0), 1e-4);
    ray = test::turned(ray, 1e-4 * normal(random), 1e-4 * normal(random));
    measurements.push_back(test::measurement_of(ray, kStart + std::llround(i / 60.0 * 1e6)));
  }
  return measurements;
}

TEST(FusionProperties, AFlightTenTimesAsLargeHasTenTimesTheErrors) {
  for (const char* estimator : {"filter", "least-squares"}) {
    const auto small = fused(scaled_flight(1.0), estimator);
    const auto large = fused(scaled_flight(10.0), estimator, 10.0);
    ASSERT_EQ(small.size(), large.size()) << estimator;
    for (std::size_t i = 0; i < small.size(); ++i) {
      const double ratio =
          large[i].estimate.covariance_ecef.trace() / small[i].estimate.covariance_ecef.trace();
      EXPECT_NEAR(ratio, 100.0, 3.0) << estimator;
      const double t_s = static_cast<double>(small[i].utime_us - kStart) * 1e-6;
      const Vector3d off = small[i].estimate.position_ecef - test::site().to_ecef(test::path(t_s));
      const Vector3d large_off =
          large[i].estimate.position_ecef - test::site().to_ecef(10.0 * test::path(t_s));
      const double sd = std::sqrt(small[i].estimate.covariance_ecef.trace());
      EXPECT_LT((large_off / 10.0 - off).norm(), 0.1 * sd) << estimator;
    }
  }
}

}  // namespace
}  // namespace ols::fusion
