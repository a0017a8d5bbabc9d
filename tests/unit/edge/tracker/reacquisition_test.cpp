// What a tracker may believe in when the picture no longer goes on as it did.
#include "edge/tracker/reacquisition.h"

#include <gtest/gtest.h>

#include <utility>

#include "edge/tracker/belief.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::SyntheticScene;

constexpr double kInterval_s = 1.0 / 15.0;

// A dark post, alike in size and darkness, not in shape.
cv::Mat with_post(cv::Mat gray) {
  cv::rectangle(gray, cv::Rect(495, 138, 12, 26), cv::Scalar(60), cv::FILLED);
  return gray;
}

TEST(Reacquisition, DoesNotTakeAPostForTheTargetAfterACut) {
  SyntheticScene scene(Backdrop::kTextured, 21);
  Tracker tracker(TrackerConfig{}, 5);
  const cv::Point2d start(300.0, 220.0);
  const auto input = [](int k, const cv::Mat& gray) {
    return TrackerInput{gray, kInterval_s * k, std::nullopt};
  };
  ASSERT_FALSE(tracker.initialise(input(0, scene.picture({400, 300}, start)),
                                  SyntheticScene::box_around(start)));
  for (int k = 1; k < 20; ++k) {
    const cv::Point2d truth(300.0 + 2.0 * k, 220.0);
    EXPECT_GT(tracker.track(input(k, scene.picture({400, 300}, truth))).output->belief, 0.8) << k;
  }
  for (int k = 20; k < 60; ++k) {
    const cv::Mat elsewhere = with_post(scene.picture({1700, 800}, std::nullopt));
    const double belief = tracker.track(input(k, elsewhere)).output->belief;
    if (k >= 25) {
      EXPECT_LT(belief, 0.5) << k;
    }
  }
}

// The prediction is of the scene before: what comes into the new one may be anywhere.
TEST(Reacquisition, FindsItsTargetAnywhereSoonAfterACut) {
  constexpr int kCut = 20, kComes = 28;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    SyntheticScene scene(Backdrop::kTextured, seed);
    Tracker tracker(TrackerConfig{}, seed);
    const auto picture = [&](int k) {
      const cv::Point2d at =
          k < kCut ? cv::Point2d(150.0 + 3.0 * k, 120.0) : cv::Point2d(560.0 - 4.0 * k, 400.0);
      const cv::Point2d camera = k < kCut ? cv::Point2d(400, 300) : cv::Point2d(1700, 800);
      const bool there = k < kCut || k >= kComes;
      return std::pair(scene.picture(camera, there ? std::optional(at) : std::nullopt), at);
    };
    const auto [first, start] = picture(0);
    ASSERT_FALSE(tracker.initialise({first, 0.0, std::nullopt}, SyntheticScene::box_around(start)));
    int found = 0;
    for (int k = 1; k < 80 && found == 0; ++k) {
      const auto [gray, truth] = picture(k);
      const auto result = tracker.track({gray, k / 30.0, std::nullopt});
      if (k >= kComes && testing::distance(result.output->pixel, truth) < 8.0)
        found = k - kComes + 1;
    }
    EXPECT_GT(found, 0) << seed;
    EXPECT_LE(found, 5) << "frames, seed " << seed;
  }
}

// Two alike cross the sky side by side, and the target turns a wing away now and then.
TEST(Reacquisition, StaysWithItsTargetBesideAnotherLikeIt) {
  SyntheticScene scene(Backdrop::kSky, 31);
  Tracker tracker(TrackerConfig{}, 5);
  const auto picture = [&](int k) {
    const cv::Point2d at(150.0 + 3.0 * k, 200.0 + 20.0 * std::sin(0.2 * k));
    cv::Mat gray = scene.pair({0, 0}, at, at + cv::Point2d(130.0, 40.0));
    if (k % 4 == 3) {
      const cv::Point2d wing = at + cv::Point2d(6.0, -9.0);
      cv::rectangle(gray, cv::Rect(cv::Point(wing), cv::Size(4, 18)), cv::Scalar(150), cv::FILLED);
    }
    return std::pair(gray, at);
  };
  const auto [first, start] = picture(0);
  ASSERT_FALSE(tracker.initialise({first, 0.0, std::nullopt}, SyntheticScene::box_around(start)));
  int near = 0;
  for (int k = 1; k < 80; ++k) {
    const auto [gray, truth] = picture(k);
    const auto result = tracker.track({gray, kInterval_s * k, std::nullopt});
    ASSERT_TRUE(result.output);
    const double off_px = testing::distance(result.output->pixel, truth);
    if (result.output->belief >= kBelieved) {
      EXPECT_LT(off_px, 8.0) << k;
    }
    near += off_px < 8.0 ? 1 : 0;
  }
  EXPECT_GT(near, 70) << "of 79; for a moment it may be off and in doubt";
}

// Where it was found, particles have the velocity of before the loss, or none.
TEST(Reacquisition, GivesAVelocityToWhatItHasFoundAndMeasuredTwice) {
  const TrackerConfig config;
  const cv::Mat gray(480, 640, CV_8UC1, cv::Scalar(90));
  const SceneMotion scene(config, HomographyFit::kLeastSquares, {gray, 0.0, std::nullopt},
                          {300.0, 200.0, 20.0, 20.0});
  const MotionModel motion(config);
  const Particle before{{300.0, 200.0}, {70.0, 0.0}, {20.0, 20.0}};
  const Eigen::Vector2d unmoved(297.0, 201.0);
  const auto velocity_px_s = [&](bool searches, const std::vector<bool>& measured,
                                 double interval_s) {
    Reacquisition reacquisition(config, before, 0.0);
    if (searches) reacquisition.start(5.0);
    Particle target = before;
    for (const bool now : measured) {
      reacquisition.predict(motion, scene, false);
      reacquisition.learn_velocity(now, unmoved, interval_s, target);
    }
    return target.velocity_px_s;
  };
  const Eigen::Vector2d& unchanged = before.velocity_px_s;
  const Eigen::Vector2d moved = (before.pixel - unmoved) / kInterval_s;
  EXPECT_EQ(velocity_px_s(true, {true, true}, kInterval_s), moved);
  EXPECT_EQ(velocity_px_s(true, {true}, kInterval_s), unchanged) << "it has leapt there";
  EXPECT_EQ(velocity_px_s(true, {true, false, true}, kInterval_s), unchanged);
  EXPECT_EQ(velocity_px_s(false, {true, true}, kInterval_s), unchanged) << "nothing was lost";
  EXPECT_EQ(velocity_px_s(true, {true, true}, 1e-3), unchanged) << "nothing is so fast";
}

TEST(Reacquisition, ScattersItsShareEvenlyOverTheRegion) {
  TrackerConfig config;
  config.search_fraction = 0.4;
  const Particle before{{300.0, 200.0}, {0.0, 0.0}, {20.0, 20.0}};
  const Eigen::Vector2d told(500.0, 100.0);
  Reacquisition reacquisition(config, before, 0.0);
  reacquisition.start_near(told, 5.0);
  std::vector<Particle> particles(100, before);
  Random random(3);
  reacquisition.scatter(particles, random);
  for (std::size_t ten = 0; ten < 100; ten += 10) {
    int moved = 0;
    for (std::size_t i = ten; i < ten + 10; ++i) {
      if (particles[i].pixel == before.pixel) continue;
      ++moved;
      EXPECT_LT((particles[i].pixel - told).norm(), 30.0) << i;
    }
    EXPECT_EQ(moved, 4) << "of the ten from " << ten;
  }
}

// Lost for seconds, and then there are two.
TEST(Reacquisition, OfTwoAlikeNeitherIsBelievedIn) {
  for (const bool two : {false, true}) {
    SyntheticScene scene(Backdrop::kTextured, 31);
    Tracker tracker(TrackerConfig{}, 5);
    const cv::Point2d start(150.0, 200.0);
    int k = 0;
    const auto track = [&](const cv::Mat& gray) {
      return tracker.track({gray, kInterval_s * ++k, std::nullopt}).output->belief;
    };
    ASSERT_FALSE(tracker.initialise({scene.picture({400, 300}, start), 0.0, std::nullopt},
                                    SyntheticScene::box_around(start)));
    for (int i = 0; i < 20; ++i)
      track(scene.picture({400, 300}, cv::Point2d(150.0 + 3.0 * i, 200.0)));
    for (int i = 0; i < 60; ++i) track(scene.picture({400, 300}, std::nullopt));
    double belief = 0.0;
    for (int i = 0; i < 30; ++i) {
      const cv::Point2d at(500.0 - 5.0 * i, 380.0), other(250.0 + 5.0 * i, 100.0);
      belief = track(two ? scene.pair({400, 300}, at, other) : scene.picture({400, 300}, at));
    }
    if (two) {
      EXPECT_LT(belief, 0.5);
    } else {
      EXPECT_GT(belief, 0.6);
      EXPECT_LT(belief, 0.85);
    }
  }
}

// Found elsewhere, it is believed in but partly; then the fusion says that it is there.
TEST(Reacquisition, WhoIsToldWhereItIsBelievesInItWholly) {
  SyntheticScene scene(Backdrop::kTextured, 31);
  Tracker tracker(TrackerConfig{}, 5);
  const cv::Point2d start(150.0, 200.0);
  int k = 0;
  const auto track = [&](const std::optional<cv::Point2d>& at) {
    const cv::Mat gray = scene.picture({400, 300}, at);
    return tracker.track({gray, kInterval_s * ++k, std::nullopt}).output->belief;
  };
  ASSERT_FALSE(tracker.initialise({scene.picture({400, 300}, start), 0.0, std::nullopt},
                                  SyntheticScene::box_around(start)));
  const auto moving = [](int i) { return cv::Point2d(500.0 - 3.0 * i, 380.0); };
  for (int i = 0; i < 20; ++i) track(cv::Point2d(150.0 + 3.0 * i, 200.0));
  for (int i = 0; i < 60; ++i) track(std::nullopt);
  double belief = 0.0;
  for (int i = 0; i < 30; ++i) belief = track(moving(i));
  EXPECT_LT(belief, 0.85);
  tracker.search_near({moving(30).x, moving(30).y}, 5.0);
  for (int i = 30; i < 60; ++i) belief = track(moving(i));
  EXPECT_GT(belief, 0.9);
}

}  // namespace
}  // namespace ols::tracker
