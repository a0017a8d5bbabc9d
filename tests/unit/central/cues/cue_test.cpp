#include "central/cues/cue.h"

#include <gtest/gtest.h>

#include "tests/unit/central/cues/cue_scene.h"

namespace ols::fusion {
namespace {

TEST(Cue, GoesStraightOnAndBecomesLessCertain) {
  Cue cue = test::good_cue();
  cue.velocity_enu_m_s = {10.0, 0.0, -1.0};
  const CueAim aim{cue, 3.0};
  const Eigen::Matrix3d R = R_ecef_enu(cue.place);
  const KinematicState now = aim.at(test::kCueTime_us),
                       later = aim.at(test::kCueTime_us + 2'000'000);
  const Eigen::Vector3d way = R.transpose() * (later.mean - now.mean).head<3>();
  EXPECT_TRUE(way.isApprox(Eigen::Vector3d(20.0, 0.0, -2.0), 1e-9));
  const Eigen::Matrix3d first = R.transpose() * now.covariance.topLeftCorner<3, 3>() * R;
  EXPECT_TRUE(
      first.isApprox(Eigen::Vector3d(100.0, 100.0, 400.0).asDiagonal().toDenseMatrix(), 1e-9));
  // 2 m/s for 2 s and 3 m/s^2 for 2 s: 4 m and 6 m more.
  const Eigen::Matrix3d then = R.transpose() * later.covariance.topLeftCorner<3, 3>() * R;
  EXPECT_NEAR(then(0, 0), 100.0 + 16.0 + 36.0, 1e-6);
  EXPECT_NEAR(then(2, 2), 400.0 + 16.0 + 36.0, 1e-6);
}

}  // namespace
}  // namespace ols::fusion
