#include "edge/tracker/tracker_core.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::distance;
using testing::frame_at;
using testing::kStart;
using testing::started;
using testing::SyntheticScene;

// A body and a boom, dark on a noisy sky, `side` px long; its middle is not that of its slopes.
cv::Mat picture(double side, const cv::Point2d& centre, cv::RNG& noise) {
  cv::Mat image(480, 640, CV_32F);
  noise.fill(image, cv::RNG::NORMAL, 190.0, 2.0);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const double u = (column - centre.x) / side, v = (row - centre.y) / side;
      const auto blob = [&](double at, double wide, double high) {
        return std::exp(-0.5 * (std::pow((u - at) / wide, 2) + std::pow(v / high, 2)));
      };
      image.at<float>(row, column) -=
          static_cast<float>(80.0 * blob(-0.1, 0.18, 0.14) + 60.0 * blob(0.3, 0.12, 0.06));
    }
  }
  image.convertTo(image, CV_8U);
  return image;
}

void expect_followed(double first_side, double growth_per_s) {
  cv::RNG noise(3);
  cv::Point2d centre(320.0, 240.0);
  Tracker tracker(TrackerConfig{}, 1);
  const cv::Rect2d box(centre.x + 0.5 - 0.6 * first_side, centre.y + 0.5 - 0.4 * first_side,
                       1.2 * first_side, 0.8 * first_side);
  ASSERT_FALSE(tracker.initialise({picture(first_side, centre, noise), 0.0, std::nullopt}, box));
  double nees = 0.0;
  constexpr int kFrames = 100;
  for (int k = 1; k <= kFrames; ++k) {
    const double side = first_side * std::exp(growth_per_s * k / 30.0);
    centre += cv::Point2d(0.7 * std::cos(0.05 * k), 0.5);
    const auto output = *tracker.track({picture(side, centre, noise), k / 30.0, {}}).output;
    const Eigen::Vector2d error(output.pixel.x() - centre.x, output.pixel.y() - centre.y);
    nees += 0.5 * error.dot(output.covariance_px2.inverse() * error) / kFrames;
    EXPECT_LT(error.norm(), 0.5) << k;
    EXPECT_GT(output.belief, 0.8) << k;
    EXPECT_LT(std::abs(std::log(output.box.width / (1.2 * side))), std::log(1.5)) << k;
  }
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 3.0);
}

TEST(TrackerCore, ATargetThatComesNearerIsFollowedAtItsSizeAndPlace) {
  expect_followed(20.0, 0.35);
}
TEST(TrackerCore, ATargetThatGoesAwayIsFollowedAtItsSizeAndPlace) { expect_followed(60.0, -0.3); }

TEST(TrackerCore, FollowsBeforeBlankSkyWithoutPrediction) {
  SyntheticScene scene(Backdrop::kSky, 2);
  Tracker tracker = started(scene);
  for (int k = 1; k < 40; ++k) {
    const cv::Point2d truth(300.0 + 6.0 * k, 220.0 - 2.0 * k);
    const TrackerResult result = tracker.track(frame_at(k, scene.picture({400, 300}, truth)));
    ASSERT_TRUE(result.output.has_value());
    EXPECT_EQ(result.output->ego_motion, EgoMotion::kNone) << k;
    EXPECT_LT(distance(result.output->pixel, truth), 1.0) << k;
    EXPECT_GT(result.output->belief, 0.8) << k;
  }
}

// Paper, section 5: without a homography, particles forced onto the frame difference find a target
// that the motion model lost.
TEST(TrackerCore, DifferenceParticlesCatchALeapBeforeSky) {
  SyntheticScene scene(Backdrop::kSky, 3);
  Tracker with = started(scene);
  TrackerConfig config;
  config.difference_fraction = 0.0;
  config.search_fraction = 0.0;
  SyntheticScene same(Backdrop::kSky, 3);
  Tracker without = started(same, config);
  const cv::Point2d leapt(480.0, 330.0);
  double off_with = 0.0;
  double off_without = 0.0;
  for (int k = 1; k < 4; ++k) {
    const cv::Mat gray = scene.picture({400, 300}, leapt);
    off_with = distance(with.track(frame_at(k, gray)).output->pixel, leapt);
    off_without = distance(without.track(frame_at(k, gray)).output->pixel, leapt);
  }
  EXPECT_LT(off_with, 1.0);
  EXPECT_GT(off_without, 50.0);
}

// A piece of empty sky looks like every other one.
TEST(TrackerCore, DoesNotBelieveInADesignationOfNothing) {
  for (const double noise_sd : {0.0, 2.0}) {
    SyntheticScene scene(Backdrop::kSky, 13, noise_sd);
    Tracker tracker(TrackerConfig{}, 5);
    const cv::Mat blank = scene.picture({400, 300}, std::nullopt);
    ASSERT_FALSE(tracker.initialise(frame_at(0, blank), SyntheticScene::box_around(kStart)));
    for (int k = 1; k < 10; ++k) {
      const cv::Mat gray = scene.picture({400, 300}, std::nullopt);
      EXPECT_LT(tracker.track(frame_at(k, gray)).output->belief, 0.5) << k;
    }
  }
}

// Nobody knows the velocity of a target just designated, here in a camera that stands still.
TEST(TrackerCore, CatchesAFastTargetFromItsFirstFrame) {
  for (const Backdrop backdrop : {Backdrop::kTextured, Backdrop::kSky}) {
    SyntheticScene scene(backdrop, 12);
    Tracker tracker = started(scene);
    for (int k = 1; k < 10; ++k) {
      const cv::Point2d truth(300.0 - 30.0 * k, 220.0 + 14.0 * k);
      const TrackerResult result = tracker.track(frame_at(k, scene.picture({400, 300}, truth)));
      ASSERT_TRUE(result.output.has_value());
      EXPECT_LT(distance(result.output->pixel, truth), 1.0) << k;
      EXPECT_GT(result.output->belief, 0.8) << k;
    }
  }
}

TEST(TrackerCore, CoastsThroughOcclusionAndFindsAgain) {
  SyntheticScene scene(Backdrop::kTextured, 5);
  Tracker tracker = started(scene);
  double lowest = 1.0;
  for (int k = 1; k < 40; ++k) {
    const cv::Point2d truth(300.0 + 2.0 * k, 220.0);
    const bool hidden = k >= 15 && k < 22;
    const cv::Mat gray =
        scene.picture({400, 300}, hidden ? std::nullopt : std::optional<cv::Point2d>(truth));
    const TrackerResult result = tracker.track(frame_at(k, gray));
    ASSERT_TRUE(result.output.has_value());
    lowest = std::min(lowest, result.output->belief);
    if (k >= 34) {
      EXPECT_LT(distance(result.output->pixel, truth), 1.5) << k;
      EXPECT_GT(result.output->belief, 0.5) << k;
    }
  }
  EXPECT_LT(lowest, 0.5);
}

TEST(TrackerCore, BeliefDropsWithinAThirdOfASecond) {
  for (const Backdrop backdrop : {Backdrop::kTextured, Backdrop::kSky}) {
    SyntheticScene scene(backdrop, 6);
    Tracker tracker = started(scene);
    double belief = 1.0;
    for (int k = 1; k < 15; ++k) {
      belief = tracker.track(frame_at(k, scene.picture({400, 300}, kStart))).output->belief;
      EXPECT_GT(belief, 0.8);
    }
    for (int k = 15; k < 20; ++k) {
      belief = tracker.track(frame_at(k, scene.picture({400, 300}, std::nullopt))).output->belief;
    }
    EXPECT_LT(belief, 0.5);
    for (int k = 20; k < 60; ++k) {
      belief = tracker.track(frame_at(k, scene.picture({400, 300}, std::nullopt))).output->belief;
      EXPECT_LT(belief, 0.5) << k;
    }
  }
}

TEST(TrackerCore, SearchNearFindsTheTargetAndOnlyTheTarget) {
  for (const bool there : {true, false}) {
    SyntheticScene scene(Backdrop::kTextured, 7);
    Tracker tracker = started(scene);
    int k = 1;
    for (; k < 20; ++k) tracker.track(frame_at(k, scene.picture({400, 300}, std::nullopt)));
    const cv::Point2d truth(150.0, 360.0);
    tracker.search_near({165.0, 345.0}, 20.0);
    double belief = 0.0;
    Eigen::Vector2d pixel;
    for (const int until = k + 15; k < until; ++k) {
      const auto target = there ? std::optional<cv::Point2d>(truth) : std::nullopt;
      const TrackerResult result = tracker.track(frame_at(k, scene.picture({400, 300}, target)));
      belief = result.output->belief;
      pixel = result.output->pixel;
    }
    if (there) {
      EXPECT_GT(belief, 0.5);
      EXPECT_LT(distance(pixel, truth), 1.5);
    } else {
      EXPECT_LT(belief, 0.5);
    }
  }
}

TEST(TrackerCore, CovarianceIsHonest) {
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SyntheticScene scene(Backdrop::kSky, seed, 6.0);
    Tracker tracker = started(scene);
    for (int k = 1; k <= 6; ++k) {
      // Fractions of a pixel of every size.
      const cv::Point2d truth(300.0 + 1.37 * k, 220.0 + 0.73 * k);
      const auto result = tracker.track(frame_at(k, scene.picture({400, 300}, truth)));
      const Eigen::Vector2d error(result.output->pixel.x() - truth.x,
                                  result.output->pixel.y() - truth.y);
      sum += error.dot(result.output->covariance_px2.inverse() * error) / 2.0;
      ++count;
    }
  }
  const double nees = sum / count;
  RecordProperty("nees", std::to_string(nees));
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2.0);
}

// search_near() speaks of the coming frame's pixels, however the camera moves up to it: a roll of
// this size about the corner takes its step, undone before it is made, thirty pixels off.
TEST(TrackerCore, SearchesWhereItIsToldThoughTheCameraRolls) {
  SyntheticScene scene(Backdrop::kSky, 4);
  TrackerConfig config;
  config.difference_fraction = config.search_fraction = 0.0;
  Tracker tracker = started(scene, config);
  Eigen::Matrix3d roll = Eigen::Matrix3d::Identity();
  roll.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(0.2).toRotationMatrix();
  const cv::Point2d told(560.0, 420.0);
  tracker.search_near({told.x, told.y}, 1.0);
  TrackerInput next = frame_at(1, scene.picture({400, 300}, told));
  next.predicted_homography = roll;
  const TrackerResult result = tracker.track(next);
  ASSERT_TRUE(result.output);
  EXPECT_EQ(result.output->ego_motion, EgoMotion::kPredicted);
  EXPECT_LT(distance(result.output->pixel, told), 2.0);
}

}  // namespace
}  // namespace ols::tracker
