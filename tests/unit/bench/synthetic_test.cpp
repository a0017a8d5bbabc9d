#include <gtest/gtest.h>

#include <Eigen/LU>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "dev/bench/synthetic_cases.h"
#include "geometry/angles.h"

namespace ols::bench {
namespace {

const Eigen::Vector2d kCentre(100.3, 80.7);
const Eigen::Vector2d kNoSmear(0.0, 0.0);

cv::Mat1f sky() { return {cv::Size(200, 160), static_cast<float>(kSkyLevel)}; }

cv::Mat1f drawn(const TargetLook& look, const Eigen::Vector2d& centre, double growth = 1.0) {
  cv::Mat1f picture = sky();
  SyntheticTarget(look).draw(picture, centre, kNoSmear, growth);
  return picture - kSkyLevel;
}

TEST(SyntheticTarget, HasTheContrastAskedForAndStandsWhereItIs) {
  for (const double width : {3.0, 6.0, 12.0, 24.0, 60.0}) {
    for (const double blur : {0.4, 2.0}) {
      const cv::Mat1f target = drawn({width, 15.0, blur}, kCentre);
      double least = 0.0;
      cv::minMaxLoc(target, &least);
      // The brightest pixel need not be the target's brightest place; of 3 pixels, parts of which
      // are sky, none is full.
      const bool small = width < 4.0;
      EXPECT_NEAR(-least / (15.0 * kNoiseSd), small ? 0.8 : 1.0, small ? 0.25 : 0.15)
          << width << " px, blur " << blur;
      const cv::Moments m = cv::moments(-target);
      const double centred_px = small ? 0.02 : 0.01;
      EXPECT_NEAR(m.m10 / m.m00, kCentre.x(), centred_px) << width << " px, blur " << blur;
      EXPECT_NEAR(m.m01 / m.m00, kCentre.y(), centred_px) << width << " px, blur " << blur;
    }
  }
}

TEST(SyntheticTarget, BoxHoldsIt) {
  const TargetLook look{30.0, 20.0, 0.4};
  const cv::Rect2d box = SyntheticTarget(look).box(kCentre);
  EXPECT_NEAR(box.width, 31.0, 1e-6);
  EXPECT_NEAR(box.x + 0.5 * box.width - 0.5, kCentre.x(), 1e-6);
  const cv::Mat1f target = drawn(look, kCentre);
  const cv::Rect wide(
      cv::Point(static_cast<int>(box.x) - 1, static_cast<int>(box.y) - 1),
      cv::Point(static_cast<int>(box.br().x) + 2, static_cast<int>(box.br().y) + 2));
  EXPECT_GT(cv::sum(target(wide))[0] / cv::sum(target)[0], 0.99);
  EXPECT_GT(cv::norm(drawn(look, kCentre, 2.0)), 1.5 * cv::norm(target));
}

// Matched filtering with the true picture reaches the bound: it is neither too low nor too high.
TEST(SyntheticTarget, BoundIsReachedByTheBestEstimator) {
  const TargetLook look{12.0, 20.0, 1.0};
  const SyntheticTarget target(look);
  const PixelNoise noise;
  tracker::Random random(3);
  constexpr double kStep = 0.05;
  constexpr int kTries = 400;
  const cv::Mat1f expected = drawn(look, kCentre);
  const cv::Mat1f dx = (drawn(look, kCentre + Eigen::Vector2d(kStep, 0)) -
                        drawn(look, kCentre - Eigen::Vector2d(kStep, 0))) /
                       (2 * kStep);
  const cv::Mat1f dy = (drawn(look, kCentre + Eigen::Vector2d(0, kStep)) -
                        drawn(look, kCentre - Eigen::Vector2d(0, kStep))) /
                       (2 * kStep);
  Eigen::Matrix2d information;
  information << dx.dot(dx), dx.dot(dy), dx.dot(dy), dy.dot(dy);
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kTries; ++i) {
    cv::Mat1f seen;
    noise.develop(expected + kSkyLevel, random).convertTo(seen, CV_32F);
    const cv::Mat1f residual = seen - kSkyLevel - expected;
    const Eigen::Vector2d error =
        information.inverse() * Eigen::Vector2d(dx.dot(residual), dy.dot(residual));
    scatter += error * error.transpose() / kTries;
  }
  const Eigen::Matrix2d bound = target.bound(sky(), kCentre, kNoSmear, 1.0);
  EXPECT_NEAR(scatter(0, 0) / bound(0, 0), 1.0, 0.2);
  EXPECT_NEAR(scatter(1, 1) / bound(1, 1), 1.0, 0.2);
}

TEST(SyntheticScene, HomographyMovesTheBackdropAsTheCameraTurns) {
  Landscape landscape(bench_camera({320, 256}));
  const AzimuthElevation from{0.3, 0.0}, to{0.3 + 20.0 / landscape.camera().fx_px, 0.0};
  const Eigen::Matrix3d H = rotation_between(landscape.camera(), from, to);
  const Eigen::Vector2d moved = (H * Eigen::Vector3d(160.0, 128.0, 1.0)).hnormalized();
  EXPECT_NEAR(moved.x(), 140.0, 0.05);  // a camera that turns right moves the scene left
  EXPECT_NEAR(moved.y(), 128.0, 0.05);
  const cv::Mat1f before = landscape.backdrop(Backdrop::kLandscape, from);
  const cv::Mat1f after = landscape.backdrop(Backdrop::kLandscape, to);
  const cv::Rect there(60, 60, 150, 120), here(40, 60, 150, 120);
  const double off = cv::norm(before(there), after(here), cv::NORM_L1) / there.area();
  const double unlike = cv::norm(before(there), after(there), cv::NORM_L1) / there.area();
  EXPECT_LT(off, 2.0);
  EXPECT_GT(unlike, 3.0 * off);
}

TEST(SyntheticScene, NoiseIsAsStated) {
  const PixelNoise noise;
  tracker::Random random(1);
  cv::Scalar mean, sd;
  cv::meanStdDev(noise.develop(sky(), random), mean, sd);
  EXPECT_NEAR(mean[0], kSkyLevel, 0.1);
  EXPECT_NEAR(sd[0], std::hypot(kNoiseSd, 1.0 / std::sqrt(12.0)), 0.05);
}

TEST(SyntheticCases, TargetStaysInThePictureAndMovesAsStated) {
  Landscape landscape(bench_camera());
  for (const BenchCase& which : bench_cases()) {
    tracker::Random random(11);
    const BenchPath path(which, landscape, random);
    double length_px = 0.0;
    for (double t = 0.0; t < which.seconds; t += kFrameInterval_s) {
      const Eigen::Vector2d at = path.target_px(t);
      ASSERT_GT(at.x(), 100.0) << which.sweep << ' ' << which.value;
      ASSERT_LT(at.x(), 540.0) << which.sweep << ' ' << which.value;
      ASSERT_GT(at.y(), 90.0) << which.sweep << ' ' << which.value;
      ASSERT_LT(at.y(), 422.0) << which.sweep << ' ' << which.value;
      length_px += (path.target_px(t + kFrameInterval_s) - at).norm();
    }
    if (which.target_path == TargetPath::kCircle) {
      EXPECT_NEAR(length_px / which.seconds, which.speed_px_s, 0.05 * which.speed_px_s + 1e-9);
    }
  }
}

// A target that stands in the world moves as the camera's homography says.
TEST(SyntheticCases, SwingingCameraMovesAStandingTarget) {
  Landscape landscape(bench_camera());
  BenchCase which;
  which.camera_path = CameraPath::kSwinging;
  which.target_path = TargetPath::kStill;
  which.pan_rate_deg_s = 20.0;
  tracker::Random random(2);
  const BenchPath path(which, landscape, random);
  const double later = 0.02;
  const Eigen::Matrix3d H =
      rotation_between(landscape.camera(), path.camera(0.0), path.camera(later));
  const Eigen::Vector2d expected = (H * path.target_px(0.0).homogeneous()).hnormalized();
  EXPECT_LT((expected - path.target_px(later)).norm(), 1e-6);
  EXPECT_NEAR(std::abs(path.target_px(later).x() - path.target_px(0.0).x()),
              radians(20.0) * later * landscape.camera().fx_px, 1.0);
}

TEST(SyntheticCases, EverySweepHasPointsOfItsOwn) {
  std::map<std::string, std::set<double>> seen;
  for (const BenchCase& which : bench_cases()) {
    EXPECT_TRUE(seen[which.sweep].insert(which.value).second) << which.sweep << which.value;
  }
  for (const auto& [sweep, values] : seen) EXPECT_GE(values.size(), 3U) << sweep;
}

}  // namespace
}  // namespace ols::bench
