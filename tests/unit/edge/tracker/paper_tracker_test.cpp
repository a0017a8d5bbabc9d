#include "edge/tracker/paper_tracker.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "edge/tracker/tracker.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::distance;
using testing::SyntheticScene;

const cv::Point2d kStart(300.0, 220.0);

TrackerInput frame_at(int frame, const cv::Mat& gray) {
  return {gray, 10.0 + frame / 15.0, std::nullopt};
}

TrackerConfig paper_mode() {
  TrackerConfig config;
  config.mode = TrackerMode::kPaper;
  return config;
}

TEST(PaperTracker, FollowsATargetBeforeAMovingBackground) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  Tracker tracker(paper_mode(), 3);
  ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                  SyntheticScene::box_around(kStart)));
  for (int k = 1; k < 25; ++k) {
    const cv::Point2d truth(300.0 + 2.5 * k, 220.0 + 1.5 * k);
    const auto result =
        tracker.track(frame_at(k, scene.picture({400.0 + 11.0 * k, 300.0 + 3.0 * k}, truth)));
    ASSERT_TRUE(result.output.has_value());
    EXPECT_EQ(result.output->ego_motion, EgoMotion::kImage) << k;
    EXPECT_LT(distance(result.output->pixel, truth), 8.0) << k;
    EXPECT_GE(result.output->belief, 0.0);
    EXPECT_LE(result.output->belief, 1.0);
  }
}

// Forced particles and those of the sky do not count: how wide the others are is the covariance. It
// is that of a particle, and the best of some hundreds errs less: before a sky by four.
TEST(PaperTracker, CovarianceIsHonest) {
  for (const Backdrop backdrop : {Backdrop::kTextured, Backdrop::kSky}) {
    double sum = 0.0, variance = 0.0, squares = 0.0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SyntheticScene scene(backdrop, seed);
      Tracker tracker(paper_mode(), seed);
      ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                      SyntheticScene::box_around(kStart)));
      for (int k = 1; k <= 12; ++k) {
        const cv::Point2d truth(300.0 + 1.37 * k, 220.0 + 0.73 * k);
        const auto output =
            *tracker.track(frame_at(k, scene.picture({400.0 + 3.0 * k, 300.0}, truth))).output;
        if (k <= 4) continue;  // the velocities are those of the first guess
        const Eigen::Vector2d error = output.pixel - Eigen::Vector2d(truth.x, truth.y);
        sum += error.dot(output.covariance_px2.inverse() * error) / 2.0;
        squares += error.squaredNorm() / 2.0;
        variance += output.covariance_px2.trace() / 2.0;
        ++count;
      }
    }
    RecordProperty("nees", std::to_string(sum / count));
    EXPECT_GT(sum / count, 0.03);
    EXPECT_LT(sum / count, 1.5);
    // Particles of the whole picture had it at some eighty.
    EXPECT_LT(std::sqrt(variance / count), 1.5) << "for " << std::sqrt(squares / count);
  }
}

TEST(PaperTracker, ForcesParticlesOntoTheFrameDifferenceBeforeBlankSky) {
  const cv::Point2d leapt(480.0, 330.0);
  for (const double share : {0.2, 0.0}) {
    SyntheticScene scene(Backdrop::kSky, 3);
    TrackerConfig config = paper_mode();
    config.difference_fraction = share;
    Tracker tracker(config, 3);
    ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                    SyntheticScene::box_around(kStart)));
    const auto result = tracker.track(frame_at(1, scene.picture({400, 300}, leapt)));
    EXPECT_EQ(result.output->ego_motion, EgoMotion::kNone);
    EXPECT_EQ(distance(result.output->pixel, leapt) < 5.0, share > 0.0);
  }
}

// The camera leaps to another part of the scene while its first frame still waits for the target to
// leave its box: from there on it is compared with what follows the leap. M_t of an alignment that
// is none is texture all over, which no candidate's mask shows, and nothing looks like the
// template.
TEST(PaperTracker, MakesTheTemplatesMaskOfFramesThatAlign) {
  SyntheticScene scene(Backdrop::kTextured, 6);
  Tracker tracker(paper_mode(), 3);
  ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                  SyntheticScene::box_around(kStart)));
  double least = 1.0;
  for (int k = 1; k < 30; ++k) {
    const double camera = k < 3 ? 400.0 : 1500.0;
    const cv::Point2d truth(300.0 + 3.0 * std::max(0, k - 3), 220.0);
    const auto output = *tracker.track(frame_at(k, scene.picture({camera, 300}, truth))).output;
    EXPECT_EQ(output.ego_motion == EgoMotion::kNone, k == 3) << k;
    EXPECT_LT(distance(output.pixel, truth), 6.0) << k;
    if (k > 20) least = std::min(least, output.belief);
  }
  EXPECT_GT(least, 0.8);
}

// The picture ends there, and what lies beyond looks like its last pixels.
TEST(PaperTracker, DoesNotFollowATargetOutOfThePicture) {
  for (const cv::Point2d& way : {cv::Point2d(-1.0, 0.0), cv::Point2d(1.0, 0.0),
                                 cv::Point2d(0.0, -1.0), cv::Point2d(0.0, 1.0)}) {
    SyntheticScene scene(Backdrop::kTextured, 5);
    Tracker tracker(paper_mode(), 3);
    const cv::Point2d start(320.0 + 300.0 * way.x, 240.0 + 220.0 * way.y);
    ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, start)),
                                    SyntheticScene::box_around(start)));
    for (int k = 1; k < 14; ++k) {
      const auto output =
          *tracker.track(frame_at(k, scene.picture({400, 300}, start + 3.0 * k * way))).output;
      EXPECT_TRUE(
          cv::Rect2d(-0.5, -0.5, 640.0, 480.0).contains({output.pixel.x(), output.pixel.y()}))
          << way << k << ": " << output.pixel.transpose();
    }
  }
}

TEST(PaperTracker, IsToldAPixelOfTheFrameGivenNext) {
  SyntheticScene scene(Backdrop::kTextured, 7);
  Tracker tracker(paper_mode(), 3);
  ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                  SyntheticScene::box_around(kStart)));
  for (int k = 1; k < 10; ++k) {
    tracker.track(frame_at(k, scene.picture({400.0 + 30.0 * k, 300.0}, std::nullopt)));
  }
  const cv::Point2d truth(150.0, 360.0);
  tracker.search_near({152.0, 359.0}, 1.0);
  const auto output = *tracker.track(frame_at(10, scene.picture({700, 300}, truth))).output;
  EXPECT_EQ(output.ego_motion, EgoMotion::kImage);
  EXPECT_LT(distance(output.pixel, truth), 3.0);
}

}  // namespace
}  // namespace ols::tracker
