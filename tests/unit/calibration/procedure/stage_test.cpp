#include "calibration/procedure/stage.h"

#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

TEST(Stage, AnObservationHasWhatThePictureTells) {
  Taken picture;
  picture.pose = 7;
  picture.utime_us = 1'780'000'000'000'000;
  picture.reading = {{120.0, 3.0, -1}, {-40.0, -2.0, 1}};
  const Observation one = observation_of(Kind::kLandmark, picture, {12.5, 80.25}, 0.2, "spire");
  EXPECT_EQ(one.kind, Kind::kLandmark);
  EXPECT_EQ(one.pose, 7);
  EXPECT_EQ(one.utime_us, picture.utime_us);
  EXPECT_EQ(one.reading.pan.counts, 120.0);
  EXPECT_EQ(one.reading.pan.approach, -1);
  EXPECT_EQ(one.reading.tilt.counts, -40.0);
  EXPECT_EQ(one.reading.pan.counts_per_s, 0.0);  // it stood
  EXPECT_EQ(one.pixel, Eigen::Vector2d(12.5, 80.25));
  EXPECT_EQ(one.sd_px, 0.2);
  EXPECT_EQ(one.reference, "spire");
}

}  // namespace
}  // namespace ols::calibration
