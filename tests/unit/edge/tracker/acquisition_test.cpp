#include "edge/tracker/acquisition.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <deque>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::SyntheticScene;

// A camera that pans over the scene along a target, and what is expected of the target.
class AcquisitionTest : public ::testing::Test {
 protected:
  using Paint = std::function<void(cv::Mat&, int frame)>;

  // Frames at 15 Hz; `camera` moves by (v, 0) a frame. Returns the first box taken.
  std::optional<cv::Rect2d> run(Backdrop backdrop, int frames, double camera_px,
                                const std::optional<cv::Point2d>& target, const Paint& paint = {}) {
    SyntheticScene scene(backdrop, 3);
    std::deque<std::pair<cv::Mat, double>> seen;  // newest first, with the camera's place
    for (int i = 0; i < frames; ++i) {
      const double x = 300.0 + camera_px * i;
      cv::Mat gray = scene.picture({x, 300.0}, target);
      if (paint) paint(gray, i);
      AcquisitionView view{gray, kExpected, 25.0, line_, drift_px_, {}};
      for (const auto& [before, then] : seen) {
        const Eigen::Matrix3d H = testing::shift_homography(then - x, 0.0);
        view.references.push_back({before, H, (H * kExpected.homogeneous()).hnormalized()});
      }
      const auto box = acquisition_.look(view);
      if (box) return box;
      seen.emplace_front(gray, x);
      if (seen.size() > 15) seen.pop_back();
    }
    return std::nullopt;
  }

  static void expect_around(const std::optional<cv::Rect2d>& box, const cv::Point2d& target) {
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->x + 0.5 * box->width - 0.5, target.x, 3.0);
    EXPECT_NEAR(box->y + 0.5 * box->height - 0.5, target.y, 3.0);
    EXPECT_GT(box->width, 8.0);
    EXPECT_LT(box->width, 50.0);
  }

  static inline const Eigen::Vector2d kExpected{320.0, 240.0};
  static inline const cv::Point2d kTarget{345.0, 228.0};  // a little off, as a heading's error does
  Eigen::Vector2d line_ = Eigen::Vector2d::Zero();
  double drift_px_ = 0.0;
  Acquisition acquisition_{AcquisitionConfig{}};
};

TEST_F(AcquisitionTest, FindsATargetThatMovesBeforeTexture) {
  expect_around(run(Backdrop::kTextured, 40, 25.0, kTarget), kTarget);
}

TEST_F(AcquisitionTest, FindsATargetThatStandsInABlankSkyWithinThreeFrames) {
  expect_around(run(Backdrop::kSky, 3, 0.0, kTarget), kTarget);
}

// Only a line is known, and not how the target moves: it is what moves evenly, anywhere on the
// line.
TEST_F(AcquisitionTest, FindsATargetThatMovesEvenlyAnywhereOnALine) {
  const auto moves_by = [](std::vector<int> places, int y = 232) {
    return [places, y](cv::Mat& gray, int i) {
      const int x = places[static_cast<std::size_t>(i) % places.size()];
      cv::rectangle(gray, {x, y, 20, 10}, cv::Scalar(70), cv::FILLED);
    };
  };
  const auto finds = [&](const Paint& paint, double camera_px = 0.0) {
    acquisition_.clear();
    return run(Backdrop::kSky, 4, camera_px, std::nullopt, paint).has_value();
  };
  const Paint even = moves_by({260, 290, 320, 350}), uneven = moves_by({300, 345, 290, 345});
  EXPECT_FALSE(finds(even)) << "a place is expected";
  line_ = {1.0, 0.0};
  drift_px_ = 60.0;
  EXPECT_TRUE(finds(even));
  EXPECT_FALSE(finds(uneven)) << "several things, or none";
  EXPECT_TRUE(finds(moves_by({40, 70, 100, 130}))) << "farther from the pixel than any gate";
  EXPECT_FALSE(finds(moves_by({260, 290, 320, 350}, 430))) << "beside the line";
  EXPECT_TRUE(finds(moves_by({560, 470, 380, 290}), 100.0)) << "the camera turns faster than it";
  drift_px_ = 10.0;
  EXPECT_FALSE(finds(even)) << "faster than a target may be";
}

TEST_F(AcquisitionTest, DoesNotTakeATargetInTwoFramesOnly) {
  EXPECT_FALSE(run(Backdrop::kSky, 2, 0.0, kTarget));
}

TEST_F(AcquisitionTest, FindsATargetBesideACloudsEdge) {
  const Paint cloud = [](cv::Mat& gray, int) {
    gray(cv::Rect(0, 260, gray.cols, 220)) += cv::Scalar(60);
  };
  expect_around(run(Backdrop::kSky, 3, 0.0, kTarget, cloud), kTarget);
}

TEST_F(AcquisitionTest, ACloudsEdgeIsNoTarget) {
  const Paint cloud = [](cv::Mat& gray, int) {
    gray(cv::Rect(0, 250, gray.cols, 230)) += cv::Scalar(60);
  };
  EXPECT_FALSE(run(Backdrop::kSky, 60, 0.0, std::nullopt, cloud));
}

TEST_F(AcquisitionTest, TwoAlikeAreNone) {
  const Paint second = [](cv::Mat& gray, int) {
    gray(cv::Rect(345 - 12, 228 - 9, 24, 18)).copyTo(gray(cv::Rect(270, 270, 24, 18)));
  };
  EXPECT_FALSE(run(Backdrop::kSky, 60, 0.0, kTarget, second));
}

TEST_F(AcquisitionTest, WhatIsPassedByIsNone) {
  const Paint passed = [](cv::Mat& gray, int i) {
    cv::circle(gray, {420 - 12 * i, 235}, 9, cv::Scalar(60), cv::FILLED);
  };
  EXPECT_FALSE(run(Backdrop::kSky, 30, 12.0, std::nullopt, passed));
}

TEST_F(AcquisitionTest, WhatIsFarFromTheExpectedPlaceIsNone) {
  EXPECT_FALSE(run(Backdrop::kSky, 30, 0.0, cv::Point2d(320.0 + 150.0, 240.0)));
}

TEST_F(AcquisitionTest, NothingThereIsNothingFound) {
  for (const double camera_px : {0.0, 3.0, 25.0}) {
    acquisition_.clear();
    EXPECT_FALSE(run(Backdrop::kSky, 60, camera_px, std::nullopt)) << camera_px;
    EXPECT_FALSE(run(Backdrop::kTextured, 60, camera_px, std::nullopt)) << camera_px;
  }
}

TEST_F(AcquisitionTest, RefusesWhatIsNoGrayPicture) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(acquisition_.look({cv::Mat(), kExpected, 25.0, {0.0, 0.0}, 0.0, {}}));
    EXPECT_FALSE(
        acquisition_.look({cv::Mat(480, 640, CV_8UC3), kExpected, 25.0, {0.0, 0.0}, 0.0, {}}));
    EXPECT_FALSE(
        acquisition_.look({cv::Mat(480, 640, CV_8U), {-1e4, 1e4}, 25.0, {0.0, 0.0}, 0.0, {}}));
  }
}

}  // namespace
}  // namespace ols::tracker
