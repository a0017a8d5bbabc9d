#include "geometry/station_calibration.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "tests/unit/geometry/crooked_station.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using test::crooked;
using test::near;
using test::some_reading;

constexpr unsigned kSeed = 20260301;
const Vector2d kPixel(900.0, 200.0);

// Sizes as a calibration leaves them, and every pair of parameters correlated by +0.9.
ModelCovariance correlated() {
  ModelParameters sd = ModelParameters::Constant(3e-5);
  sd.segment<2>(kFocal) << 1.0, 1e-5;
  sd.segment<2>(kCx) << 3.0, 3.0;
  sd.segment<2>(kK1) << 1e-2, 1e-1;
  sd[kExposureOffset] = 1e-4;
  sd.segment<3>(kEast).setConstant(0.02);
  ModelCovariance R = ModelCovariance::Constant(0.9);
  R.diagonal().setOnes();
  return sd.asDiagonal() * R * sd.asDiagonal();
}

CountedSight seen(const UnitReading& reading) {
  CountedSight sight;
  sight.pixel = kPixel;
  sight.covariance_px2.setIdentity();
  sight.reading = reading;
  return sight;
}

// Its parameters are known.
StationCalibration exact(const StationModel& model) {
  StationCalibration calibration;
  calibration.model = model;
  return calibration;
}

// Every parameter drawn from its covariance, and the direction computed by the model itself.
TEST(StationCalibration, TheSystematicCovarianceIsThatOfDrawnParameters) {
  std::mt19937 random(kSeed);
  const StationCalibration calibration{crooked(random), correlated(), 0.0};
  const UnitReading reading = some_reading(random);
  const auto told = systematic_covariance(calibration, reading, kPixel);
  ASSERT_TRUE(told);
  const auto here = sight(calibration, seen(reading));
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(here->direction);
  const Eigen::LLT<ModelCovariance> root(calibration.covariance);
  std::normal_distribution<double> normal;
  Eigen::Matrix2d drawn = Eigen::Matrix2d::Zero();
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    ModelParameters by;
    for (double& one : by) one = normal(random);
    by = root.matrixL() * by;
    by.segment<3>(kEast).setZero();  // moves the origin, not the direction
    const StationCalibration there = exact(changed(calibration.model, by));
    const Vector2d off =
        tangent.transpose() * enu_from_azimuth_elevation(sight(there, seen(reading))->direction);
    drawn += off * off.transpose() / kDraws;
  }
  EXPECT_TRUE(near(drawn, *told, 0.06 * told->trace()));
  EXPECT_GT(told->trace(), 1e-9);
}

TEST(StationCalibration, OfOneParameterItIsTheSquareOfACentralDifference) {
  std::mt19937 random(kSeed + 1);
  StationCalibration calibration = exact(crooked(random));
  const UnitReading reading = some_reading(random);
  const auto here = sight(calibration, seen(reading));
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(here->direction);
  for (int k = 0; k < kEast; ++k) {
    const double step = k == kFocal || k == kCx || k == kCy ? 1e-2 : 1e-6;
    calibration.covariance.setZero();
    calibration.covariance(k, k) = step * step;
    const auto at = [&](double by) {
      const StationCalibration there =
          exact(changed(calibration.model, by * ModelParameters::Unit(k)));
      return enu_from_azimuth_elevation(sight(there, seen(reading))->direction);
    };
    const Vector2d by = tangent.transpose() * (at(step) - at(-step)) / 2.0;
    const Eigen::Matrix2d numeric = by * by.transpose();
    const auto told = systematic_covariance(calibration, reading, kPixel);
    EXPECT_TRUE(near(*told, numeric, 1e-4 * numeric.trace() + 1e-18)) << "parameter " << k;
  }
}

// Designation is systematic, angle errors of a pose are white, and the place has its own.
TEST(StationCalibration, SightKeepsTheKindsOfErrorsApart) {
  std::mt19937 random(kSeed + 2);
  StationCalibration calibration{crooked(random), correlated(), 0.0};
  CountedSight measured = seen(some_reading(random));
  const auto plain = sight(calibration, measured);
  EXPECT_TRUE(near(plain->covariance_systematic,
                   *systematic_covariance(calibration, measured.reading, kPixel), 1e-18));
  EXPECT_NEAR(plain->origin_sd_enu_m.y(), 0.02, 1e-12);
  measured.aim_sd_px = 1.0;
  calibration.angle_sd_rad = 1e-4;
  const auto more = sight(calibration, measured);
  EXPECT_GT((more->covariance_systematic - plain->covariance_systematic).trace(), 1e-9);
  EXPECT_NEAR(2.0 * std::pow(more->aim_sd_rad, 2),
              (more->covariance_systematic - plain->covariance_systematic).trace(), 1e-12);
  EXPECT_GT((more->covariance_white - plain->covariance_white).trace(), 0.9e-8);
  measured.angles_systematic_rad2 = 1e-8 * Eigen::Matrix2d::Identity();
  const auto lasting = sight(calibration, measured);
  EXPECT_GT((lasting->covariance_systematic - more->covariance_systematic).trace(), 0.9e-8);
  EXPECT_TRUE(near(lasting->covariance_white, more->covariance_white, 0.0));
}

TEST(StationCalibration, FromWhichSideIsPartOfTheDoubtWhereItIsNotKnown) {
  std::mt19937 random(kSeed + 3);
  StationCalibration calibration = exact(crooked(random));
  calibration.model.pan.backlash_rad = 1e-4;
  UnitReading reading = some_reading(random);
  EXPECT_LT(systematic_covariance(calibration, reading, kPixel)->trace(), 1e-20);
  const auto at = [&](int approach) {
    reading.pan.approach = approach;
    return sight(calibration, seen(reading));
  };
  const auto left = at(1), right = at(-1), unknown = at(0);
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(unknown->direction);
  const Vector2d half =
      tangent.transpose() *
      (enu_from_azimuth_elevation(left->direction) - enu_from_azimuth_elevation(right->direction)) /
      2.0;
  EXPECT_TRUE(
      near(unknown->covariance_systematic, half * half.transpose(), 1e-4 * half.squaredNorm()));
}

TEST(StationCalibration, TheUnitPointsWhereItWasTold) {
  std::mt19937 random(kSeed + 4);
  std::uniform_real_distribution<double> pan(-2.7, 2.7), tilt(-0.8, 0.5);
  for (int i = 0; i < 100; ++i) {
    const StationModel model = crooked(random);
    const PanTilt wanted{pan(random), tilt(random)};
    for (const int approach : {1, -1}) {
      const UnitCounts counts = counts_for(model, wanted, approach, -approach);
      UnitReading reading;
      reading.pan = {counts.pan, 0.0, approach};
      reading.tilt = {counts.tilt, 0.0, -approach};
      StationModel still = model;
      still.exposure_offset_s = 0.0;
      const PanTilt got = corrected_angles(still, reading);
      EXPECT_NEAR(got.pan_rad, wanted.pan_rad, 1e-11);
      EXPECT_NEAR(got.tilt_rad, wanted.tilt_rad, 1e-11);
    }
  }
}

// A unit that turns at 30 degrees a second and exposes a millisecond late sees 108 arc seconds on.
TEST(StationCalibration, ALateExposureIsSeenWhereTheUnitHasTurnedTo) {
  StationCalibration calibration;
  UnitReading reading;
  reading.pan.counts_per_s = 30.0 / 360.0 * 112000.0;
  const auto prompt = sight(calibration, seen(reading));
  calibration.model.exposure_offset_s = 1e-3;
  const auto late = sight(calibration, seen(reading));
  const double turned_rad = prompt->direction.azimuth_rad - late->direction.azimuth_rad;
  EXPECT_NEAR(turned_rad * 648000.0 / EIGEN_PI, 108.0, 0.5);
}

}  // namespace
}  // namespace ols
