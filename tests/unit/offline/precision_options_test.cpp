#include "tools/offline/precision_options.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::offline {
namespace {

StationRow row() {
  StationRow row;
  row.station = "a";
  row.latitude_deg = 49.2;
  row.longitude_deg = 16.6;
  row.height_m = 300.0;
  return row;
}

TEST(PrecisionOptions, APixelIsAnAngleByTheFocalLength) {
  MeasurementOptions options;
  options.pixel_sd_px = 2.0;
  options.pixel_um = 5.0;
  options.focal_length_mm = 100.0;
  EXPECT_NEAR(planned_station(row(), options).white_rad, 1e-4, 1e-15);
}

TEST(PrecisionOptions, AStationsOwnDeviationsReplaceThoseOfTheOptions) {
  StationRow own = row();
  const CalibrationSd before = planned_station(own, {}).calibration;
  EXPECT_NEAR(before.heading_rad, radians(MeasurementOptions{}.heading_sd_deg), 1e-15);
  own.position_sd_m = 1.5;
  own.pointing_sd_deg = 0.3;
  const CalibrationSd after = planned_station(own, {}).calibration;
  EXPECT_EQ(after.position_m, 1.5);
  EXPECT_NEAR(after.mount_rad, radians(0.3), 1e-15);
  EXPECT_EQ(after.heading_rad + after.tilt_rad, 0.0) << "it stands for all three together";
}

TEST(PrecisionOptions, ATargetFliesInAnyDirection) {
  const Geodetic place{radians(49.2), radians(16.6), 350.0};
  MeasurementOptions at_30_m_s;
  at_30_m_s.speed_m_s = 30.0;
  const PlannedTarget target = planned_target(place, at_30_m_s);
  EXPECT_NEAR(geodetic_from_ecef(target.p_ecef).height_m, 350.0, 1e-6);
  EXPECT_NEAR(std::sqrt(target.velocity_moment_ecef.trace()), 30.0, 1e-9);
}

TEST(PrecisionOptions, AnOptionOutOfItsRangeIsRefused) {
  CLI::App app;
  MeasurementOptions options;
  add_measurement_options(app, options);
  app.parse("--heading-sd-deg 0.5 --exposures 10");
  EXPECT_EQ(options.heading_sd_deg, 0.5);
  EXPECT_EQ(options.exposures, 10.0);
  EXPECT_THROW(app.parse("--heading-sd-deg -0.1"), CLI::ValidationError);
  EXPECT_THROW(app.parse("--exposures 0"), CLI::ValidationError);
}

}  // namespace
}  // namespace ols::offline
