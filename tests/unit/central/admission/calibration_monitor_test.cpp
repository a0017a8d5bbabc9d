#include "central/admission/calibration_monitor.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::fusion {
namespace {

constexpr double kArcsec = kPi / 648000.0;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

StatedCalibration in_use() { return {CalibrationState::kInUse, 1, 6.0 * kArcsec}; }
FoundBias found(double across, double up) {
  return {kArcsec * Eigen::Vector2d(across, up), kArcsec * Eigen::Vector2d(16.0, 16.0)};
}

TEST(CalibrationMonitor, ABiasWithinTheStatementIsNone) {
  EXPECT_EQ(calibration_alarm("alfa", in_use(), found(60.0, -60.0)), "");
  EXPECT_EQ(calibration_alarm("alfa", in_use(), found(kNaN, kNaN)), "") << "not observable";
}

TEST(CalibrationMonitor, ALargerOneNamesTheStation) {
  EXPECT_EQ(
      calibration_alarm("alfa", in_use(), found(-90.0, 10.0)),
      "station alfa: bearings contradict its calibration: off by -90 arc seconds across and 10 "
      "in elevation: check its reference views");
  EXPECT_NE(calibration_alarm("alfa", in_use(), found(kNaN, 90.0)), "");
}

TEST(CalibrationMonitor, WithoutACalibrationInUseThereIsNothingToDoubt) {
  for (const auto state :
       {CalibrationState::kNone, CalibrationState::kRefused, CalibrationState::kDoubted}) {
    StatedCalibration stated = in_use();
    stated.state = state;
    EXPECT_EQ(calibration_alarm("alfa", stated, found(300.0, 0.0)), "");
  }
}

}  // namespace
}  // namespace ols::fusion
