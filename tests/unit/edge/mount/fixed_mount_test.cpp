#include "edge/mount/fixed/fixed_mount.h"

#include <gtest/gtest.h>

#include "edge/mount/fixed/fixed_kind.h"
#include "geometry/angles.h"

namespace ols::mount {
namespace {

const PanTilt kAngles{radians(10.0), radians(5.0)};

TEST(FixedMount, TellsItsAnglesTwentyTimesASecond) {
  const auto samples = fixed_samples(kAngles, 100.0, 100.201);
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_NEAR(samples.front().time_s, 100.05, 1e-9);
  EXPECT_NEAR(samples.back().time_s, 100.2, 1e-9);
  for (const AngleSample& sample : samples) {
    EXPECT_EQ(sample.angles.pan_rad, kAngles.pan_rad);
    EXPECT_EQ(sample.angles.tilt_rad, kAngles.tilt_rad);
  }
  EXPECT_TRUE(fixed_samples(kAngles, 100.0, 100.04).empty());
  EXPECT_LE(fixed_samples(kAngles, 0.0, 100.0).size(), 21U) << "after a pause, the last second";
}

TEST(FixedMount, AnExposureHasTheAnglesWithoutDoubt) {
  FixedKind kind;
  kind.fixed.angles = kAngles;
  AngleHistory history(kind.traits().angles);
  for (const AngleSample& sample : fixed_samples(kAngles, 99.0, 100.0)) history.add(sample);
  for (const double time_s : {99.5, 99.987, 100.06}) {
    const auto at = history.at(time_s);
    ASSERT_TRUE(at) << time_s;
    EXPECT_DOUBLE_EQ(at->angles.pan_rad, kAngles.pan_rad);
    EXPECT_DOUBLE_EQ(at->rate.tilt_rad, 0.0);
    EXPECT_LT(at->covariance.norm(), kVirtualCount_rad * kVirtualCount_rad);
  }
}

TEST(FixedMount, IsReadyAtOnceAndObeysNoOrder) {
  FixedMount fixed({kAngles});
  EXPECT_EQ(fixed.reference(), Reference::kTrusted);
  fixed.set_goal(Goal{0.0, {1.0, 1.0}, {}, 1e9});
  fixed.home();
  ASSERT_TRUE(fixed.limits());
  EXPECT_EQ(fixed.limits()->pan_min_rad, fixed.limits()->pan_max_rad);
  EXPECT_EQ(fixed.limits()->count.pan_rad, radians(1e-4));
  ASSERT_FALSE(fixed.take_samples().empty());
  EXPECT_EQ(fixed.report().state, device::DeviceState::kOk);
  EXPECT_EQ(fixed.report().name, "ptu");
  EXPECT_EQ(fixed.report().text, "fixed at pan 10.00, tilt 5.00 deg");
}

}  // namespace
}  // namespace ols::mount
