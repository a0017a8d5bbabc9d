#include "sim/world/sun.h"

#include <gtest/gtest.h>

#include "calibration/sky.h"
#include "geometry/angles.h"
#include "sim/world/calibration_round.h"

namespace ols::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::int64_t kNoon_us = 1'779'966'000'000'000;  // 28 May 2026, 11:00 UTC

TEST(Sun, StandsWhereTheProductsOtherTheoryHasIt) {
  const Geodetic place{radians(49.2266), radians(16.5969), 310.0};
  const calibration::Air air{kRoundPressure_hPa, kRoundTemperature_degC};
  for (const std::int64_t hour : {-5, -2, 0, 3, 5}) {
    const std::int64_t utime_us = kNoon_us + hour * 3'600'000'000;
    const auto other = calibration::sun_direction(utime_us, place, air, {kRoundUt1MinusUtc_s});
    const Vector3d enu = R_ecef_enu(place).transpose() * other.ecef;
    const SunTruth sun = sun_over(place, utime_us);
    ASSERT_GT(sun.enu.z(), 0.17) << hour;
    EXPECT_LT(degrees((sun.enu - enu).norm()) * 3600.0, 1.0) << hour;
    EXPECT_NEAR(degrees(sun.radius_rad) * 3600.0, 947.0, 2.0) << "near aphelion";
  }
}

TEST(Sun, ItsDiscIsCentredThroughAFilterAndAllElseIsBlack) {
  cv::Mat gray(200, 200, CV_8U, cv::Scalar(130));
  draw_filter(gray);
  draw_sun({90.3, 104.6}, 31.0, true, gray);
  EXPECT_LT(gray.at<std::uint8_t>(10, 10), 8);
  EXPECT_LT(gray.at<std::uint8_t>(104, 130), 8) << "without glare";
  Vector3d sum = Vector3d::Zero();
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      sum += (gray.at<std::uint8_t>(y, x) - 3) * Vector3d(x, y, 1.0);
    }
  }
  EXPECT_LT((sum.head<2>() / sum.z() - Vector2d(90.3, 104.6)).norm(), 0.01);
}

TEST(Sun, WithoutAFilterItBurnsOutAndItsGlareIsAllAround) {
  cv::Mat gray(200, 200, CV_8U, cv::Scalar(130));
  draw_sun({100.0, 100.0}, 31.0, false, gray);
  EXPECT_EQ(gray.at<std::uint8_t>(100, 100), 255);
  EXPECT_EQ(gray.at<std::uint8_t>(100, 140), 255);
  EXPECT_GT(gray.at<std::uint8_t>(5, 5), 200);
}

}  // namespace
}  // namespace ols::sim
