#include "calibration/parameters.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

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

}  // namespace
}  // namespace ols::calibration
