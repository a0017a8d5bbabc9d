#include "edge/camera/exposure_log.h"

#include <gtest/gtest.h>

namespace ols::camera {
namespace {

constexpr double kPeriod_s = 0.1;

TEST(ExposureLog, KnowsTheOneExposureThereIs) {
  const ExposureLog log(0.005, kPeriod_s);
  EXPECT_DOUBLE_EQ(log.at(3.0).exposure_s, 0.005);
  EXPECT_DOUBLE_EQ(log.at(3.0).sd_s, 0.0);
  EXPECT_DOUBLE_EQ(log.newest_s(), 0.005);
}

TEST(ExposureLog, BeforeAChangeTheOldOneAndAFramePeriodAfterItTheNewOneIsCertain) {
  ExposureLog log(0.004, kPeriod_s);
  log.change(10.0, 10.002, 0.008);
  EXPECT_DOUBLE_EQ(log.newest_s(), 0.008);
  EXPECT_DOUBLE_EQ(log.at(9.999).exposure_s, 0.004);
  EXPECT_DOUBLE_EQ(log.at(9.999).sd_s, 0.0);
  EXPECT_DOUBLE_EQ(log.at(10.103).exposure_s, 0.008);
  EXPECT_DOUBLE_EQ(log.at(10.103).sd_s, 0.0);
}

TEST(ExposureLog, InBetweenEitherMayBeTrue) {
  ExposureLog log(0.004, kPeriod_s);
  log.change(10.0, 10.002, 0.008);
  for (const double start_s : {10.001, 10.05, 10.101}) {
    EXPECT_DOUBLE_EQ(log.at(start_s).exposure_s, 0.006);
    EXPECT_DOUBLE_EQ(log.at(start_s).sd_s, 0.002);
  }
}

TEST(ExposureLog, ManyChangesEndAtTheLastOne) {
  ExposureLog log(0.001, kPeriod_s);
  for (int i = 1; i <= 50; ++i) log.change(i, i + 0.001, 0.001 * i);
  EXPECT_DOUBLE_EQ(log.at(50.5).exposure_s, 0.050);
  EXPECT_DOUBLE_EQ(log.at(50.5).sd_s, 0.0);
  EXPECT_DOUBLE_EQ(log.at(48.5).exposure_s, 0.048);
}

}  // namespace
}  // namespace ols::camera
