#include "edge/calibration/calibrated_unit.h"

#include <gtest/gtest.h>

#include "edge/frames/pointing_model.h"
#include "geometry/angles.h"
#include "tests/unit/edge/station/angle_sample.h"

namespace ols::station {
namespace {

constexpr double kArcsec = kPi / 648000.0;

StationCalibration bent() {
  StationCalibration calibration;
  StationModel& model = calibration.model;
  model.geometry.position = {radians(49.2), radians(16.6), 250.0};
  model.geometry.chain.mount_z_rad = 300.0 * kArcsec;
  model.geometry.chain.trunnion_rad = 60.0 * kArcsec;
  model.pan.cos1_rad = 40.0 * kArcsec;
  model.pan.worm_sin_rad = 10.0 * kArcsec;
  model.pan.backlash_rad = 20.0 * kArcsec;
  model.tilt.sin1_rad = -40.0 * kArcsec;
  model.tilt.backlash_rad = 20.0 * kArcsec;
  calibration.covariance.diagonal().setConstant(1e-10);
  return calibration;
}

StationConfig config() {
  StationConfig config;
  config.calibration = bent();
  config.geometry = config.calibration->model.geometry;
  config.limits = {-radians(159), radians(159), -radians(46), radians(31)};
  return config;
}

TEST(CalibratedUnit, CountsAreExactWhateverTheUnitPrints) {
  CalibratedUnit unit(bent());
  const double printed = radians(11.5714 / 3600.0);
  unit.set_count({printed, printed});
  EXPECT_TRUE(unit.fits());
  const UnitReading reading = unit.reading({49467 * printed, -100 * printed}, {}, {});
  EXPECT_NEAR(reading.pan.counts, 49467.0, 1e-6);
  EXPECT_NEAR(reading.tilt.counts, -100.0, 1e-6);
  unit.set_count({2.0 * printed, 2.0 * printed});
  EXPECT_FALSE(unit.fits()) << "half steps";
}

TEST(CalibratedUnit, AStationSeesTheDirectionThatItWasPointedTo) {
  PointingModel pointing(config());
  PanTilt at;
  double now_s = 0.0;
  for (const auto& [azimuth, elevation] : {std::pair{70.0, 12.0}, {71.0, 12.5}, {20.0, 25.0}}) {
    const AzimuthElevation wanted{radians(azimuth), radians(elevation)};
    const auto goal = pointing.aim(wanted);
    ASSERT_TRUE(goal);
    now_s += 1.0;
    pointing.add(angle_sample(now_s, at));
    pointing.add(angle_sample(now_s + 0.1, *goal));
    pointing.add(angle_sample(now_s + 0.2, *goal));
    at = *goal;
    const AzimuthElevation seen = optical_axis(pointing.geometry(), pointing.angles_now());
    EXPECT_NEAR(seen.azimuth_rad, wanted.azimuth_rad, 1e-9);
    EXPECT_NEAR(seen.elevation_rad, wanted.elevation_rad, 1e-9);
    const PanTilt plain = *aim_along(pointing.geometry(), wanted);
    EXPECT_GT(std::abs(goal->pan_rad - plain.pan_rad), 3.0 * kArcsec) << "its errors matter";
  }
}

TEST(CalibratedUnit, ABearingHasTheWholeCovariance) {
  PointingModel pointing(config());
  for (const double time_s : {10.0, 10.1, 10.2}) {
    pointing.add(angle_sample(time_s, {0.1 * time_s, 0.0}));
  }
  const auto unit = pointing.angles_at(10.15);
  ASSERT_TRUE(unit);
  EXPECT_EQ(unit->reading.pan.approach, 1);
  EXPECT_NEAR(unit->reading.pan.counts_per_s, 0.1 / (2.0 * kPi) * 112000.0, 1e-6);
  PixelSight pixel;
  pixel.pixel = {700.0, 300.0};
  const auto line = pointing.sight(pixel, *unit);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->covariance_systematic,
            *systematic_covariance(bent(), unit->reading, pixel.pixel));
}

// A unit that turns further than half around goes on across 180 degrees: it comes from the side of
// that short way, although the direction's angle says that it lies far on the other side.
TEST(CalibratedUnit, AcrossHalfATurnTheUnitComesFromTheSideOfItsWay) {
  StationConfig wide = config();
  wide.limits.pan_min_rad = -radians(200);
  wide.limits.pan_max_rad = radians(200);
  for (const int sign : {1, -1}) {
    PointingModel pointing(wide);
    const PanTilt here{sign * radians(176), 0.0};
    pointing.add(angle_sample(10.0, {here.pan_rad - sign * 0.1, 0.0}));
    pointing.add(angle_sample(10.1, here));
    const double wanted_rad = sign * radians(184);
    const auto direction = optical_axis(pointing.geometry(), {wanted_rad, 0.0});
    const auto goal = pointing.aim(direction);
    ASSERT_TRUE(goal);
    EXPECT_NEAR(goal->pan_rad, wanted_rad, 100.0 * kArcsec);
    for (int i = 1; i <= 20; ++i) {
      pointing.add(angle_sample(
          10.1 + 0.1 * i,
          {here.pan_rad + 0.05 * i * (goal->pan_rad - here.pan_rad), 0.05 * i * goal->tilt_rad}));
    }
    EXPECT_NEAR(pointing.angles_now().pan_rad, wanted_rad, 0.01 * kArcsec) << sign;
  }
}

TEST(CalibratedUnit, OneOfOtherCountsIsUsedWithoutItsCalibration) {
  PointingModel pointing(config());
  EXPECT_TRUE(pointing.calibrated());
  mount::Limits limits = config().limits;
  limits.count = {radians(23.1428 / 3600.0), radians(23.1428 / 3600.0)};
  pointing.set_limits(limits);
  EXPECT_FALSE(pointing.calibrated());
  const auto goal = pointing.aim({radians(20.0), 0.0});
  EXPECT_EQ(goal->pan_rad, aim_along(pointing.geometry(), {radians(20.0), 0.0})->pan_rad);
}

TEST(CalibratedUnit, DoubtGrowsWhatABearingStates) {
  PointingModel pointing(config());
  const auto systematic = [&pointing] {
    pointing.add(angle_sample(10.0, {}));
    pointing.add(angle_sample(10.1, {}));
    PixelSight pixel;
    pixel.pixel = {639.5, 479.5};
    const auto line = pointing.sight(pixel, *pointing.angles_at(10.05));
    return line->covariance_systematic;
  };
  const Eigen::Matrix2d before = systematic();
  const auto revision = pointing.pose_revision();
  pointing.doubt_setup(40.0 * kArcsec, 20.0 * kArcsec);
  const Eigen::Matrix2d more = systematic() - before;
  EXPECT_NEAR(std::sqrt(more(0, 0)), 40.0 * kArcsec, 0.5 * kArcsec);
  EXPECT_NEAR(std::sqrt(more(1, 1)), 20.0 * kArcsec, 0.5 * kArcsec);
  EXPECT_EQ(pointing.pose_revision(), revision + 1) << "the fusion begins anew with its bias";
}

TEST(CalibratedUnit, ACalibrationCanBeExchangedAndDropped) {
  PointingModel pointing(config());
  const auto revision = pointing.pose_revision();
  StationConfig plain = config();
  plain.geometry.chain.mount_z_rad = 0.0;
  pointing.use(plain.geometry, std::nullopt);
  EXPECT_FALSE(pointing.calibrated());
  EXPECT_EQ(pointing.geometry().chain.mount_z_rad, 0.0);
  EXPECT_EQ(pointing.pose_revision(), revision + 1);
  pointing.use(config().geometry, bent());
  EXPECT_TRUE(pointing.calibrated());
}

}  // namespace
}  // namespace ols::station
