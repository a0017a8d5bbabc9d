#include "calibration/parameter_change.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::kArcsec;

ParameterChange change_of(const StationModel& truth, int parameter) {
  const Adjustment adjustment(network_of(test::scenery_around(truth, 24)));
  return parameter_change(adjustment.network(), calibrate(adjustment).fit, 0, parameter);
}

TEST(ParameterChange, IsWhatTheSceneryHasFoundInItsOwnSigmas) {
  StationModel truth = test::hill();
  truth.pan.backlash_rad = 20.0 * kArcsec;  // as a new unit's
  const ParameterChange change = change_of(truth, kPanBacklash);
  EXPECT_NEAR(change.by / kArcsec, 20.0, 1.0);
  EXPECT_NEAR(change.sd / kArcsec, 20.0, 1.0);
  EXPECT_TRUE(change.is_told);
  EXPECT_FALSE(change.is_large());
  truth.pan.backlash_rad = 80.0 * kArcsec;
  EXPECT_TRUE(change_of(truth, kPanBacklash).is_large());
}

TEST(ParameterChange, OfWhatSceneryCannotSeeNothingIsTold) {
  const ParameterChange change = change_of(test::hill(), kExposureOffset);
  EXPECT_FALSE(change.is_told);
  EXPECT_FALSE(change.is_large());
}

}  // namespace
}  // namespace ols::calibration
