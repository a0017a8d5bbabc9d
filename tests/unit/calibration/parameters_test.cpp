#include "calibration/parameters.h"

#include <gtest/gtest.h>

#include "calibration/parameter_change.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::kArcsec;

// Each parameter changes what its name in the files says, and only that.
TEST(Parameters, TheInstrumentsAreThoseThatAChangeMoves) {
  const StationModel model = test::hill();
  for (int k = 0; k < kInstrumentParameters; ++k) {
    const InstrumentVector by =
        instrument_of(changed(model, 1e-3 * ModelParameters::Unit(k))) - instrument_of(model);
    EXPECT_NEAR((by - 1e-3 * InstrumentVector::Unit(k)).norm(), 0.0, 1e-9) << k;
  }
}

TEST(Parameters, AnglesAreInDegreesInFiles) {
  EXPECT_DOUBLE_EQ(to_file(kHeading, kPi), 180.0);
  EXPECT_DOUBLE_EQ(from_file(kMountZ, 90.0), kPi / 2.0);
  EXPECT_DOUBLE_EQ(to_file(kFocal, 13333.0), 13333.0);
  for (const ParameterText& text : parameter_texts()) {
    EXPECT_EQ(text.is_angle, std::string(text.key).ends_with("_deg")) << text.key;
  }
}

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
