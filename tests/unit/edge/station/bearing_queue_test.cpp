#include "edge/station/bearing_queue.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"

namespace ols::station {
namespace {

class BearingQueueTest : public testing::Test {
 protected:
  static StationConfig config() {
    StationConfig config;
    config.geometry.position = {radians(49.2), radians(16.6), 250.0};
    return config;
  }
  static mount::AngleSample sample(double time_s) {
    mount::AngleSample sample;
    sample.time_s = time_s;
    return sample;
  }
  static PixelMeasurement pixel(double time_s) {
    PixelMeasurement pixel;
    pixel.arrived_s = pixel.mid_exposure_s = time_s;
    pixel.pixel = {639.5, 479.5};
    pixel.covariance_px2 = Eigen::Matrix2d::Identity();
    pixel.track_id = 7;
    return pixel;
  }
  PointingModel pointing{config()};
  BearingQueue queue{config()};
};

TEST_F(BearingQueueTest, WaitsForTheAnglesOnBothSidesOfTheExposure) {
  pointing.add(sample(10.0));
  queue.add(pixel(10.01));
  EXPECT_TRUE(queue.take(pointing, 10.02).empty());
  pointing.add(sample(10.02));
  const auto made = queue.take(pointing, 10.03);
  ASSERT_EQ(made.size(), 1U);
  EXPECT_TRUE(made.front().to_send);
  EXPECT_EQ(made.front().bearing.mid_exposure_s, 10.01);
  EXPECT_EQ(made.front().bearing.track_id, 7);
  EXPECT_TRUE(queue.take(pointing, 10.04).empty()) << "once";
  EXPECT_NEAR(queue.frame_latency_s(), 0.002, 1e-9);
}

TEST_F(BearingQueueTest, AnErrorOfTheMountsPlaceIsSystematic) {
  constexpr double kPlace_rad = 2e-3;
  for (const double time_s : {10.0, 10.02}) {
    mount::AngleSample with_place = sample(time_s);
    with_place.place_sd = {kPlace_rad, kPlace_rad};
    pointing.add(with_place);
  }
  queue.add(pixel(10.01));
  const auto made = queue.take(pointing, 10.03);
  ASSERT_EQ(made.size(), 1U);
  const Eigen::Matrix2d systematic = made.front().bearing.sight.covariance_systematic;
  EXPECT_NEAR(systematic(0, 0), kPlace_rad * kPlace_rad, 1e-8);
  EXPECT_NEAR(systematic(1, 1), kPlace_rad * kPlace_rad, 1e-8);
}

TEST_F(BearingQueueTest, OneOfADetectedObjectStatesItsRateAndSize) {
  for (const double time_s : {10.0, 10.02, 10.04}) pointing.add(sample(time_s));
  queue.add(pixel(10.05));
  PixelMeasurement detected = pixel(10.01);
  detected.detected = DetectedPixel{.velocity_px_s = {100.0, -50.0},
                                    .velocity_sd_px_s = 10.0,
                                    .size_px = 6.0,
                                    .size_sd_px = 2.0,
                                    .across_px = 4.0,
                                    .size_noise_px = 0.5,
                                    .signal = 9.0,
                                    .image_bearings = 3};
  queue.add(detected);
  const auto made = queue.take(pointing, 10.051);
  ASSERT_EQ(made.size(), 1U) << "it does not wait for the newer one";
  const double px_rad = 1.0 / config().geometry.camera.fx_px;
  const DetectedObject& object = made.front().bearing.detected.value();
  EXPECT_NEAR(object.rate_rad_s.x(), 100.0 * px_rad, 0.01 * px_rad);
  EXPECT_NEAR(object.rate_rad_s.y(), 50.0 * px_rad, 0.01 * px_rad);
  EXPECT_NEAR(std::sqrt(object.rate_covariance(0, 0)), 10.0 * px_rad, 0.01 * px_rad);
  EXPECT_NEAR(object.size_rad, 6.0 * px_rad, 0.01 * px_rad);
  EXPECT_NEAR(object.size_sd_rad, 2.0 * px_rad, 0.01 * px_rad);
  EXPECT_NEAR(object.across_rad, 4.0 * px_rad, 0.01 * px_rad);
  EXPECT_NEAR(object.size_noise_rad, 0.5 * px_rad, 0.01 * px_rad);
  EXPECT_EQ(object.signal, 9.0);
  EXPECT_EQ(object.image_bearings, 3);
  EXPECT_EQ(queue.counters().at("tracklet_bearings"), 1.0);
  EXPECT_EQ(queue.frame_latency_s(), 0.0) << "that is the followed target's";
}

TEST_F(BearingQueueTest, DoesNotWaitForever) {
  pointing.add(sample(9.98));
  pointing.add(sample(10.0));
  queue.add(pixel(10.01));
  EXPECT_EQ(queue.take(pointing, 10.05).size(), 1U) << "extrapolated";
  queue.add(pixel(20.0));
  EXPECT_TRUE(queue.take(pointing, 20.05).empty());
  EXPECT_EQ(queue.counters().at("frames_without_angles"), 1.0);
}

TEST_F(BearingQueueTest, OneWithoutAPositionOrTooOldIsGoodToFollowOnly) {
  for (const double time_s : {10.0, 10.02, 10.04}) pointing.add(sample(time_s));
  queue.add(pixel(10.01));
  const auto late = queue.take(pointing, 12.0);
  ASSERT_EQ(late.size(), 1U);
  EXPECT_FALSE(late.front().to_send);
  EXPECT_EQ(queue.counters().at("bearings_too_old"), 1.0);
  sensors::StationPose unknown = pointing.pose();
  unknown.position_source = sensors::PoseSource::kNone;
  pointing.set_pose(unknown);
  queue.add(pixel(10.03));
  const auto made = queue.take(pointing, 10.05);
  ASSERT_EQ(made.size(), 1U);
  EXPECT_FALSE(made.front().to_send);
  EXPECT_EQ(queue.counters().at("bearings_without_pose"), 1.0);
  EXPECT_FALSE(queue.counters().contains("bearings"));
}

}  // namespace
}  // namespace ols::station
