#include "sim/world/exposed_unit.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::sim {
namespace {

constexpr double kArcsec = kPi / 648000.0;

PanTilt turning(double time_s) { return {0.1 * time_s, -0.05 * time_s}; }

ExposureTruth exposure() {
  ExposureTruth exposure;
  exposure.exposure_s = 0.002;
  return exposure;
}

TEST(ExposedUnit, AnExactOneStandsWhereItCounts) {
  ExposedUnit unit({}, {});
  ExposureTruth seen = exposure();
  unit.expose(turning, 10.0, seen);
  EXPECT_EQ(seen.mid.pan_rad, turning(10.0).pan_rad);
  EXPECT_EQ(seen.start.pan_rad, turning(9.999).pan_rad);
  EXPECT_EQ(seen.end.tilt_rad, turning(10.001).tilt_rad);
  EXPECT_EQ(unit.longest_wait_s(), 0.0);
}

TEST(ExposedUnit, ALateExposureSeesTheUnitFurtherOn) {
  UnitTruth truth;
  truth.exact = false;
  truth.exposure_offset_s = 0.003;
  PtuUnitConfig config;
  config.resolution_arcsec = 360.0 * 3600.0 / 112000.0;
  ExposedUnit unit(truth, config);
  ExposureTruth seen = exposure();
  unit.expose(turning, 10.0, seen);
  EXPECT_NEAR(seen.mid.pan_rad, turning(10.003).pan_rad, 1e-12);
  EXPECT_NEAR(seen.end.pan_rad - seen.start.pan_rad, 0.1 * 0.002, 1e-12);
  EXPECT_EQ(unit.longest_wait_s(), 0.003);
}

// Between two exposures the unit went away and came back from the other side.
TEST(ExposedUnit, TheSlackRemembersWhatNoExposureSaw) {
  UnitTruth truth;
  truth.exact = false;
  truth.pan.slack_rad = 20.0 * kArcsec;
  ExposedUnit unit(truth, {});
  const auto there_and_back = [](double time_s) {
    const double into = time_s - 10.0;
    return PanTilt{into < 0.0 ? 0.1 * into : (into < 0.5 ? 0.1 * into : 0.1 * (1.0 - into)), 0.0};
  };
  ExposureTruth before = exposure(), after = exposure();
  unit.expose(there_and_back, 9.9, before);
  unit.expose(there_and_back, 10.0, before);
  unit.expose(there_and_back, 11.0, after);
  EXPECT_NEAR((after.mid.pan_rad - before.mid.pan_rad) / kArcsec, 20.0, 0.01);
}

}  // namespace
}  // namespace ols::sim
