#include "edge/tracker/tracker.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::distance;
using testing::frame_at;
using testing::kStart;
using testing::shift_homography;
using testing::started;
using testing::SyntheticScene;

TEST(Tracker, FollowsBeforeMovingBackground) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  Tracker tracker = started(scene);
  for (int k = 1; k < 40; ++k) {
    const cv::Point2d camera(400.0 + 11.0 * k, 300.0 + 3.0 * k);
    const cv::Point2d truth(300.0 + 2.5 * k, 220.0 + 1.5 * k);
    const TrackerResult result = tracker.track(frame_at(k, scene.picture(camera, truth)));
    ASSERT_TRUE(result.output.has_value());
    EXPECT_EQ(result.output->ego_motion, EgoMotion::kImage) << k;
    EXPECT_LT(distance(result.output->pixel, truth), 1.0) << k;
    EXPECT_GT(result.output->belief, 0.8) << k;
    EXPECT_NEAR(result.output->box.width, 24.0, 5.0);
  }
}

// A camera that turns 150 px a frame before blank sky; only the PTU knows.
TEST(Tracker, FollowsFastTurnByPredictedHomography) {
  SyntheticScene scene(Backdrop::kSky, 4);
  Tracker tracker = started(scene);
  for (int k = 1; k < 12; ++k) {
    // To and fro, faster than the motion model could follow.
    const double turn = k % 2 == 0 ? -150.0 : 150.0;
    const cv::Point2d truth(300.0 + (k % 2 == 0 ? 0.0 : 150.0) + 1.0 * k, 220.0);
    TrackerInput input = frame_at(k, scene.picture({400, 300}, truth));
    input.predicted_homography = shift_homography(turn, 0.0);
    const TrackerResult result = tracker.track(input);
    ASSERT_TRUE(result.output.has_value());
    EXPECT_EQ(result.output->ego_motion, EgoMotion::kPredicted) << k;
    EXPECT_LT(distance(result.output->pixel, truth), 1.0) << k;
    EXPECT_GT(result.output->belief, 0.7) << k;
  }
}

// Text that is burnt into the picture, or dirt on the lens: it does not turn with the camera.
cv::Mat with_text(cv::Mat gray) {
  for (int line = 0; line < 3; ++line) {
    cv::putText(gray, "AZ 105.21 EL 0.67", {20, 30 + 24 * line}, cv::FONT_HERSHEY_SIMPLEX, 0.7,
                cv::Scalar(230), 2);
  }
  return gray;
}

// The text alone has corners, and stands still; only the PTU knows that the camera turns.
TEST(Tracker, FollowsByThePredictionWhereOnlyBurntInTextIsToBeSeen) {
  for (const double step_px : {3.0, 6.0, 12.0, 20.0, 30.0, 60.0, 120.0}) {
    SyntheticScene scene(Backdrop::kSky, 4);
    Tracker tracker(TrackerConfig{}, 5);
    double at = kStart.x;
    int near = 0;
    ASSERT_FALSE(tracker.initialise(frame_at(0, with_text(scene.picture({400, 300}, kStart))),
                                    SyntheticScene::box_around(kStart)));
    constexpr int kFrames = 40;
    for (int k = 1; k <= kFrames; ++k) {
      const double turn = (k / 2) % 2 == 0 ? -step_px : step_px;
      at += turn;
      const cv::Point2d truth(at, 220.0 + k);
      TrackerInput input = frame_at(k, with_text(scene.picture({400, 300}, truth)));
      input.predicted_homography = shift_homography(turn, 0.0);
      const auto result = tracker.track(input);
      const bool on_target = distance(result.output->pixel, truth) < 5.0;
      near += on_target && result.output->belief > 0.5 ? 1 : 0;
    }
    EXPECT_GT(near, 0.9 * kFrames) << step_px;
  }
}

// A gear that slips, or angles of another moment: the picture knows better.
TEST(Tracker, FollowsByThePictureWhereThePredictionIsWrong) {
  for (const double wrong_px : {6.0, 12.0, 30.0, 60.0, 200.0}) {
    SyntheticScene scene(Backdrop::kTextured, 4);
    Tracker tracker = started(scene);
    for (int k = 1; k <= 40; ++k) {
      const cv::Point2d truth(300.0 + 3.0 * k, 220.0 + k);
      TrackerInput input = frame_at(k, scene.picture({400.0 + 8.0 * k, 300}, truth));
      const double off = (k / 3) % 2 == 0 ? wrong_px : -wrong_px;
      input.predicted_homography = shift_homography(-8.0 + off, 0.0);
      const auto result = tracker.track(input);
      EXPECT_LT(distance(result.output->pixel, truth), 2.0) << wrong_px << ' ' << k;
      EXPECT_GT(result.output->belief, 0.7) << wrong_px << ' ' << k;
    }
  }
}

// A homography is one up to a factor.
TEST(Tracker, TakesAPredictionOfAnyScale) {
  for (const TrackerMode mode : {TrackerMode::kFull, TrackerMode::kPaper}) {
    TrackerConfig config;
    config.mode = mode;
    std::vector<TrackerOutput> outputs;
    for (const double factor : {1.0, 0x1p1020, -0x1p-20}) {
      SyntheticScene scene(Backdrop::kSky, 4);
      Tracker tracker = started(scene, config);
      for (int k = 1; k < 4; ++k) {
        TrackerInput input = frame_at(k, scene.picture({400, 300}, kStart));
        input.predicted_homography = factor * shift_homography(1.0, 0.0);
        outputs.push_back(*tracker.track(input).output);
      }
      EXPECT_EQ(outputs.back().pixel, outputs[2].pixel) << factor;
      EXPECT_EQ(outputs.back().belief, outputs[2].belief) << factor;
    }
  }
}

// The picture's own motion, and one of the PTU that is off by a little, or by more than a camera
// turns between two frames.
TEST(Tracker, TellsHowFarThePredictionIsOffThePicture) {
  for (const TrackerMode mode : {TrackerMode::kFull, TrackerMode::kPaper}) {
    TrackerConfig config;
    config.mode = mode;
    SyntheticScene scene(Backdrop::kTextured, 4);
    Tracker tracker = started(scene, config);
    int k = 0;
    for (const double off_px : {0.0, 12.0, 450.0}) {
      ++k;
      TrackerInput input = frame_at(k, scene.picture({400.0 + 6.0 * k, 300}, kStart));
      input.predicted_homography = shift_homography(-6.0 + off_px, 0.0);
      const auto output = *tracker.track(input).output;
      EXPECT_EQ(output.ego_motion, EgoMotion::kImage);
      ASSERT_TRUE(output.prediction_error_px);
      EXPECT_NEAR(*output.prediction_error_px, off_px, 1.0);
      EXPECT_EQ(output.prediction_dropped, off_px > 400.0);
    }
    ++k;
    TrackerInput input = frame_at(k, scene.picture({400.0 + 6.0 * k, 300}, kStart));
    input.predicted_homography = Eigen::Matrix3d::Zero();
    const auto output = *tracker.track(input).output;
    EXPECT_EQ(output.prediction_error_px, std::hypot(640.0, 480.0));
    EXPECT_TRUE(output.prediction_dropped);
  }
}

TEST(Tracker, TellsThatAPredictionWasDroppedBeforeBlankSkyToo) {
  SyntheticScene scene(Backdrop::kSky, 4);
  Tracker tracker = started(scene);
  TrackerInput input = frame_at(1, scene.picture({400, 300}, kStart));
  input.predicted_homography = shift_homography(450.0, 0.0);
  const auto output = *tracker.track(input).output;
  EXPECT_TRUE(output.prediction_dropped);
  EXPECT_EQ(output.prediction_error_px, std::nullopt);
  EXPECT_EQ(output.ego_motion, EgoMotion::kNone);
}

TEST(Tracker, IsTheSameTwiceToTheBit) {
  std::vector<TrackerOutput> runs[2];
  for (auto& run : runs) {
    // The library's own threads and random numbers must not matter.
    cv::setNumThreads(&run == &runs[0] ? 1 : 4);
    cv::theRNG().state = &run == &runs[0] ? 1 : 99;
    SyntheticScene scene(Backdrop::kTextured, 8);
    Tracker tracker = started(scene);
    for (int k = 1; k < 25; ++k) {
      const cv::Point2d truth(300.0 + 3.0 * k, 220.0);
      run.push_back(
          *tracker.track(frame_at(k, scene.picture({400.0 + 5.0 * k, 300.0}, truth))).output);
    }
  }
  for (std::size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0][i].pixel, runs[1][i].pixel);
    EXPECT_EQ(runs[0][i].covariance_px2, runs[1][i].covariance_px2);
    EXPECT_EQ(runs[0][i].belief, runs[1][i].belief);
    EXPECT_EQ(runs[0][i].box, runs[1][i].box);
  }
}

TEST(Tracker, RefusesWhatItCannotUse) {
  SyntheticScene scene(Backdrop::kSky, 9);
  const cv::Mat good = scene.picture({400, 300}, kStart);
  const cv::Rect2d box = SyntheticScene::box_around(kStart);
  Tracker tracker(TrackerConfig{}, 1);
  EXPECT_EQ(tracker.track(frame_at(0, good)).error, TrackerError::kNotInitialised);
  EXPECT_EQ(tracker.initialise(frame_at(0, {}), box), TrackerError::kEmptyFrame);
  EXPECT_EQ(tracker.initialise(frame_at(0, cv::Mat(480, 640, CV_8UC3)), box),
            TrackerError::kFrameFormat);
  EXPECT_EQ(tracker.initialise(frame_at(0, cv::Mat(480, 640, CV_16U)), box),
            TrackerError::kFrameFormat);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const cv::Rect2d& wrong :
       {cv::Rect2d(700, 10, 20, 20), cv::Rect2d(10, 10, 0, 20), cv::Rect2d(10, 10, 20, -5),
        cv::Rect2d(nan, 10, 20, 20), cv::Rect2d(-40, 10, 20, 20), cv::Rect2d(0, 0, 900, 900)}) {
    EXPECT_EQ(tracker.initialise(frame_at(0, good), wrong), TrackerError::kBox);
  }
  EXPECT_FALSE(tracker.initialised());
  ASSERT_EQ(tracker.initialise(frame_at(0, good), box), std::nullopt);
  EXPECT_EQ(tracker.track(frame_at(1, {})).error, TrackerError::kEmptyFrame);
  EXPECT_EQ(tracker.track(frame_at(1, cv::Mat(480, 640, CV_8UC3))).error,
            TrackerError::kFrameFormat);
  EXPECT_EQ(tracker.track(frame_at(1, cv::Mat(400, 640, CV_8U))).error, TrackerError::kFrameSize);
  EXPECT_EQ(tracker.track(frame_at(0, good)).error, TrackerError::kTime);
  EXPECT_EQ(tracker.track({good, nan, std::nullopt}).error, TrackerError::kTime);
  EXPECT_EQ(tracker.track({good, 101.0, Eigen::Matrix3d::Constant(nan)}).error,
            TrackerError::kHomography);
  for (const auto error : {TrackerError::kNotInitialised, TrackerError::kEmptyFrame,
                           TrackerError::kFrameFormat, TrackerError::kFrameSize,
                           TrackerError::kTime, TrackerError::kHomography, TrackerError::kBox}) {
    EXPECT_STRNE(to_string(error), "unknown");
  }
}

TEST(Tracker, IsAsItWasAfterARefusedFrame) {
  std::vector<TrackerOutput> outputs;
  for (const bool disturbed : {false, true}) {
    SyntheticScene scene(Backdrop::kSky, 10);
    Tracker tracker = started(scene);
    if (disturbed) {
      EXPECT_TRUE(tracker.track(frame_at(1, {})).error);
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const cv::Mat black(480, 640, CV_8U, cv::Scalar(0));
      EXPECT_TRUE(tracker.track(frame_at(0, black)).error);
      EXPECT_TRUE(tracker.track(frame_at(1, cv::Mat(400, 640, CV_8U, cv::Scalar(0)))).error);
      EXPECT_TRUE(tracker.track(frame_at(1, cv::Mat(480, 640, CV_8UC3, cv::Scalar(0)))).error);
      EXPECT_TRUE(tracker.track({black, nan, std::nullopt}).error);
      EXPECT_TRUE(tracker.track({black, 101.0, Eigen::Matrix3d::Constant(nan)}).error);
      EXPECT_TRUE(tracker.initialise(frame_at(1, black), {0, 0, -1, -1}));
      tracker.search_near({nan, 0.0}, 1.0);
    }
    outputs.push_back(*tracker.track(frame_at(1, scene.picture({400, 300}, kStart))).output);
  }
  EXPECT_EQ(outputs[0].pixel, outputs[1].pixel);
  EXPECT_EQ(outputs[0].belief, outputs[1].belief);
}

// Pictures and predictions that mean nothing give an output that is finite nevertheless.
TEST(Tracker, GivesFiniteOutputForSenselessInput) {
  SyntheticScene scene(Backdrop::kTextured, 11);
  Tracker tracker = started(scene);
  cv::RNG noise(3);
  double later_s = 0.0;
  for (int k = 1; k < 60; ++k) {
    cv::Mat gray(480, 640, CV_8U, cv::Scalar(k % 3 == 0 ? 0 : 255));
    if (k % 3 == 1) noise.fill(gray, cv::RNG::UNIFORM, 0, 256);
    TrackerInput input = frame_at(k, gray);
    if (k % 4 == 0) later_s += 1e6 * k;
    if (k % 7 == 0) tracker.search_near({1e200, -1e200}, 1e200);
    input.time_s += later_s;
    if (k % 4 == 1) input.predicted_homography = Eigen::Matrix3d::Zero();
    if (k % 4 == 2) input.predicted_homography = shift_homography(200.0, -100.0);
    const TrackerResult result = tracker.track(input);
    ASSERT_TRUE(result.output.has_value());
    EXPECT_TRUE(result.output->pixel.allFinite());
    EXPECT_TRUE(result.output->covariance_px2.allFinite());
    EXPECT_GT(result.output->covariance_px2.determinant(), 0.0);
    EXPECT_TRUE(std::isfinite(result.output->box.width) && result.output->box.width > 0.0);
    EXPECT_GE(result.output->belief, 0.0);
    EXPECT_LE(result.output->belief, 1.0);
  }
}

// A target put aside goes on to the bit as if the other one had never been.
TEST(Tracker, TakesBackWhatWasSetAside) {
  SyntheticScene scene(Backdrop::kTextured, 8);
  const auto picture = [&](int k) {
    return scene.picture({400.0 + 5.0 * k, 300.0}, cv::Point2d(300.0 + 2.0 * k, 220.0));
  };
  std::vector<cv::Mat> pictures;
  for (int k = 0; k < 8; ++k) pictures.push_back(picture(k));
  Tracker one({}, 5), other({}, 5);
  for (Tracker* tracker : {&one, &other}) {
    ASSERT_FALSE(tracker->initialise(frame_at(0, pictures[0]), SyntheticScene::box_around(kStart)));
    for (int k = 1; k < 4; ++k) ASSERT_TRUE(tracker->track(frame_at(k, pictures[k])).output);
  }
  one.set_aside();
  EXPECT_FALSE(one.initialised());
  ASSERT_FALSE(one.initialise(frame_at(4, pictures[4]), {100.0, 100.0, 30.0, 30.0}));
  ASSERT_TRUE(one.track(frame_at(5, pictures[5])).output);
  one.take_back();
  for (int k = 4; k < 8; ++k) {
    EXPECT_EQ(one.track(frame_at(k, pictures[k])).output->pixel,
              other.track(frame_at(k, pictures[k])).output->pixel);
  }
  one.take_back();  // once
  EXPECT_TRUE(one.initialised());
}

// A clock that goes on by one at each look: every stage that is run takes a second.
TEST(StageTimes, ChargeEachStageByTheClockHandedIn) {
  for (const TrackerMode mode : {TrackerMode::kPaper, TrackerMode::kFull}) {
    SyntheticScene scene(Backdrop::kTextured, 1);
    TrackerConfig config;
    config.mode = mode;
    Tracker tracker(config, 3);
    ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                    SyntheticScene::box_around(kStart)));
    tracker.track(frame_at(1, scene.picture({400, 300}, kStart)));
    EXPECT_EQ(tracker.stage_times().of(Stage::kWeighting), 0.0);  // no clock, no times
    double now = 0.0;
    tracker.set_stage_clock([&now] { return now += 1.0; });
    tracker.track(frame_at(2, scene.picture({400, 300}, kStart)));
    const auto run = mode == TrackerMode::kPaper
                         ? std::vector{Stage::kReduction, Stage::kEgoMotion, Stage::kPrediction,
                                       Stage::kProposals, Stage::kWeighting, Stage::kLearning}
                         : std::vector{Stage::kReduction, Stage::kEgoMotion, Stage::kRecognition,
                                       Stage::kMasks,     Stage::kPosition,  Stage::kLearning};
    for (const Stage stage : run) {
      EXPECT_GE(tracker.stage_times().of(stage), 1.0) << static_cast<int>(stage);
    }
  }
}

}  // namespace
}  // namespace ols::tracker
