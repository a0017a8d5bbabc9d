#include "calibration/procedure/stage.h"

#include <gtest/gtest.h>

#include "calibration/procedure/learned_heading.h"
#include "tests/unit/calibration/scene.h"

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

TEST(LearnedHeading, OneSightingTellsIt) {
  const StationModel truth = test::hill();
  const Observation one = test::landmark(35.0, 12.0, "mast");
  const Eigen::Vector3d place = test::place_seen(truth, one, 700.0, 0.0).ecef;
  StationModel believed = truth;
  believed.geometry.chain.heading_rad = radians(310.0);
  const auto heading = learned_heading(believed, one.reading, one.pixel, place);
  ASSERT_TRUE(heading);
  // The camera stands elsewhere by its lever arms, at the heading that was believed.
  EXPECT_NEAR(*heading, truth.geometry.chain.heading_rad, 0.15 / 700.0);
}

}  // namespace
}  // namespace ols::calibration
