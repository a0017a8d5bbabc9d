#include "edge/station/detected_objects.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"

namespace ols::station {
namespace {

class DetectedObjectsTest : public testing::Test {
 protected:
  DetectedObjectsTest() { begin({}); }

  void begin(const DetectionConfig& detection) {
    config_.geometry.position = {radians(49.2), radians(16.6), 250.0};
    config_.detection = detection;
    objects_.emplace(config_);
    for (int i = 0; i < 100; ++i) {
      // The mount turns by a degree a second.
      pointing_.add({.time_s = 0.02 * i, .time_sd_s = 1e-4, .angles = {radians(0.02 * i), 0.0}});
    }
  }
  void frame(double time_s, const std::optional<FollowedBox>& followed = std::nullopt) {
    camera::Frame frame;
    frame.mid_exposure_s = time_s;
    objects_->on_frame(frame, followed, time_s);
  }
  std::optional<detector::Picture> take(double now_s) { return objects_->take(pointing_, now_s); }
  // A confirmed object at rest in the scene, which the newest image shows.
  static detector::Tracklet object(long id, double x, double y, double log_ratio = 9.0) {
    detector::Detection detection;
    detection.pixel = {x, y};
    detection.size_px = {6.0, 4.0};
    detection.signal_to_noise = 11.0;
    detection.clear = true;
    detector::Tracklet tracklet(id, detection, 1280.0);
    tracklet.predict(Eigen::Matrix3d::Identity(), 0.1);
    tracklet.update(detection);
    tracklet.weigh(log_ratio, 100.0);
    tracklet.confirm(true);
    return tracklet;
  }
  std::vector<PixelMeasurement> found(std::vector<detector::Tracklet> objects) {
    const double mid_s = taken_->mid_exposure_s;
    return objects_->on_found(
        {mid_s, std::move(objects), false}, [this] { return ++ids_; }, mid_s);
  }
  // An image in which these objects are found.
  std::vector<PixelMeasurement> image(double time_s, std::vector<detector::Tracklet> objects,
                                      const std::optional<FollowedBox>& followed = std::nullopt) {
    frame(time_s, followed);
    taken_ = take(time_s);
    if (!taken_) return {};
    return found(std::move(objects));
  }
  double counter(const char* name) const {
    const auto& counters = objects_->counters();
    return counters.contains(name) ? counters.at(name) : 0.0;
  }

  StationConfig config_;
  PointingModel pointing_{config_};
  std::optional<DetectedObjects> objects_;
  std::optional<detector::Picture> taken_;
  std::int64_t ids_ = 7;  // designations so far
};

TEST_F(DetectedObjectsTest, AnObjectHasTheTimeOfItsRow) {
  camera::Frame frame;
  frame.gray = cv::Mat::zeros(960, 1280, CV_8U);
  frame.mid_exposure_s = 0.5;
  frame.row_readout_s = 0.03;
  objects_->on_frame(frame, {}, 0.5);
  taken_ = take(0.5);
  ASSERT_TRUE(taken_);
  const auto pixels = found({object(1, 640.0, 480.0)});
  ASSERT_EQ(pixels.size(), 1U);
  EXPECT_NEAR(pixels.front().mid_exposure_s, 0.515, 1e-4);
}

TEST_F(DetectedObjectsTest, ItLooksAtTheConfiguredRate) {
  int looked = 0;
  for (int i = 0; i < 30; ++i) {
    frame(i / 20.0);
    taken_ = take(i / 20.0);
    if (!taken_) continue;
    ++looked;
    found({});
  }
  EXPECT_EQ(looked, 15);
  EXPECT_EQ(counter("detector_images"), 15.0);
  EXPECT_EQ(counter("detector_images_dropped"), 0.0);
}

TEST_F(DetectedObjectsTest, APictureComesWithTheMountsMotionSinceTheOneBefore) {
  image(0.2, {});
  frame(0.5);
  taken_ = take(0.5);
  ASSERT_TRUE(taken_ && taken_->motion);
  const Eigen::Vector3d moved = *taken_->motion * Eigen::Vector3d(639.5, 479.5, 1.0);
  const double expected_px = radians(0.3) * config_.geometry.camera.fx_px;
  EXPECT_NEAR(std::abs(moved.hnormalized().x() - 639.5), expected_px, 0.1);
}

TEST_F(DetectedObjectsTest, AtNightAPictureComesWithTheStarsMotion) {
  for (const bool night : {false, true}) {
    image(night ? 0.7 : 0.2, {});
    frame(night ? 0.9 : 0.4);
    taken_ = objects_->take(pointing_, night ? 0.9 : 0.4, night);
    ASSERT_TRUE(taken_);
    EXPECT_EQ(taken_->stars.motion.has_value(), night);
    found({});
  }
}

TEST_F(DetectedObjectsTest, ItWaitsForTheAnglesAfterTheExposureButNotForLong) {
  frame(1.99);
  EXPECT_FALSE(take(1.995));
  EXPECT_TRUE(take(1.99 + config_.angle_wait_s + 1e-3));
}

TEST_F(DetectedObjectsTest, WhileItIsBusyTheNewestWinsAndOthersAreCounted) {
  frame(0.3);
  taken_ = take(0.3);
  ASSERT_TRUE(taken_);
  for (const double time_s : {0.4, 0.45, 0.5, 0.55}) {
    frame(time_s);
    EXPECT_FALSE(take(time_s)) << "one at a time";
  }
  found({});
  taken_ = take(0.56);
  ASSERT_TRUE(taken_);
  EXPECT_EQ(taken_->mid_exposure_s, 0.55);
  EXPECT_EQ(counter("detector_images_dropped"), 1.0);
}

TEST_F(DetectedObjectsTest, EachObjectKeepsAnIdThatNoDesignationHas) {
  EXPECT_EQ(image(0.1, {object(1, 300, 200), object(2, 600, 200)}).size(), 2U);
  const auto sent = image(0.2, {object(2, 603, 200), object(3, 900, 200)});
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[0].track_id, 9);
  EXPECT_EQ(sent[1].track_id, 10);
  EXPECT_EQ(sent[0].pixel, Eigen::Vector2d(603, 200));
  EXPECT_EQ(sent[0].detected->image_bearings, 2);
  EXPECT_EQ(sent[0].detected->size_px, 6.0);
  EXPECT_GT(sent[0].belief, 0.99);
  EXPECT_EQ(counter("tracklets"), 3.0);
}

TEST_F(DetectedObjectsTest, TheFollowedTargetIsNotSentAgain) {
  const FollowedBox followed{{290.0, 190.0, 20.0, 20.0}, 7};
  const auto sent = image(0.1, {object(1, 302, 199), object(2, 330, 199)}, followed);
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].pixel.x(), 330.0);
  EXPECT_FALSE(objects_->take_detection_of(6)) << "of another target";
  const auto seen = objects_->take_detection_of(7);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->size_px, 6.0);
  EXPECT_FALSE(seen->is_tracklet);
  EXPECT_FALSE(objects_->take_detection_of(7)) << "a second time";
  EXPECT_EQ(image(0.2, {object(1, 302, 199)}).size(), 1U) << "it is lost";
}

TEST_F(DetectedObjectsTest, ASizeIsThatOfTheImageAlone) {
  detector::Tracklet beating = object(1, 300, 200);
  detector::Detection wide;
  wide.pixel = {300, 200};
  wide.size_px = {12.0, 4.0};
  beating.update(wide);
  const auto sent = image(0.1, {beating});
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].detected->size_px, 12.0);
  EXPECT_EQ(sent[0].detected->across_px, 4.0);
  EXPECT_EQ(sent[0].detected->size_noise_px, 0.0) << "unknown: a box has no outline";
}

TEST_F(DetectedObjectsTest, AnOutlineIsBetterThanABox) {
  cv::Mat1b gray(480, 640, std::uint8_t{150});
  cv::circle(gray, {300, 200}, 5, cv::Scalar(50), cv::FILLED);
  detector::Tracklet round = object(1, 300, 200);
  round.measure_outline(gray);
  const auto sent = image(0.1, {round});
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_NEAR(sent[0].detected->size_px, 11.0, 1.0);
  EXPECT_NEAR(sent[0].detected->across_px, sent[0].detected->size_px, 0.01);
  EXPECT_GT(sent[0].detected->size_noise_px, 0.0);
  EXPECT_LT(sent[0].detected->size_noise_px, 0.2);
}

TEST_F(DetectedObjectsTest, OfManyTheLikeliestAreSent) {
  DetectionConfig few;
  few.max_bearings = 2;
  begin(few);
  const auto sent =
      image(0.1, {object(1, 300, 200, 4.0), object(2, 400, 200, 9.0), object(3, 500, 200, 6.0)});
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[0].pixel.x(), 400.0);
  EXPECT_EQ(sent[1].pixel.x(), 500.0);
  EXPECT_EQ(counter("tracklets_not_sent"), 1.0);
}

TEST_F(DetectedObjectsTest, WhatTheImageDoesNotShowIsNotSent) {
  detector::Tracklet unseen = object(1, 300, 200);
  unseen.miss();
  EXPECT_TRUE(image(0.1, {unseen}).empty());
}

TEST_F(DetectedObjectsTest, AResultWhoseAnglesAreForgottenIsNone) {
  frame(0.1);
  taken_ = take(0.1);
  ASSERT_TRUE(taken_);
  objects_->forget_angles();
  EXPECT_TRUE(found({object(1, 300, 200)}).empty());
  EXPECT_FALSE(objects_->newest());
  frame(0.3);
  taken_ = take(0.3);
  ASSERT_TRUE(taken_);
  EXPECT_FALSE(taken_->motion) << "from where to where is unknown";
}

TEST_F(DetectedObjectsTest, OneThatIsNotEnabledLooksAtNothing) {
  DetectionConfig off;
  off.enabled = false;
  begin(off);
  frame(0.1);
  EXPECT_FALSE(take(0.2));
}

}  // namespace
}  // namespace ols::station
