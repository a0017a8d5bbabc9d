#include "edge/camera/auto_exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <vector>

namespace ols::camera {
namespace {

constexpr ExposureLimits kLimits{
    .exposure_min_us = 20.0, .exposure_max_us = 4000.0, .gain_min_dB = 0.0, .gain_max_dB = 24.0};
const cv::Rect2d kBox(150.0, 110.0, 20.0, 16.0);

// A scene before a camera whose settings take `delay` frames to show. Levels are those that 1000 us
// and 0 dB give.
struct Scene {
  double sky = 90.0, ground = 40.0, target = 20.0;
  ExposureSetting setting{.exposure_us = 1000.0, .gain_dB = 0.0};
  int delay = 2;
  std::deque<ExposureSetting> coming{};

  cv::Mat frame() {
    coming.push_back(setting);
    const ExposureSetting seen = coming.front();
    if (static_cast<int>(coming.size()) > delay) coming.pop_front();
    const double light = seen.exposure_us / 1000.0 * std::pow(10.0, seen.gain_dB / 20.0);
    const auto level = [&](double at_unit) { return cv::Scalar(at_unit * light); };
    cv::Mat gray(240, 320, CV_8UC1, level(sky));
    gray.rowRange(160, 240).setTo(level(ground));
    gray(cv::Rect(kBox)).setTo(level(target));
    return gray;
  }
};

// The settings that were chosen.
std::vector<ExposureSetting> run(Scene& scene, AutoExposure& controller, int frames,
                                 std::optional<cv::Rect2d> box) {
  std::vector<ExposureSetting> changes;
  for (int i = 0; i < frames; ++i) {
    const auto next = controller.step(measure_levels(scene.frame(), box));
    if (!next) continue;
    scene.setting = *next;
    controller.applied(*next);
    changes.push_back(*next);
  }
  return changes;
}

AutoExposure controller(const Scene& scene) {
  return AutoExposure(AutoExposureConfig{}, kLimits, scene.setting);
}

TEST(MeasureLevels, OfTheWholePictureWithoutATarget) {
  const cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(77));
  const PictureLevels levels = measure_levels(gray, std::nullopt);
  EXPECT_FALSE(levels.target);
  EXPECT_DOUBLE_EQ(levels.mean, 77.0);
  EXPECT_DOUBLE_EQ(levels.bright, 77.0);
  EXPECT_DOUBLE_EQ(levels.saturated, 0.0);
}

TEST(MeasureLevels, OfTheBrighterOneOfTargetAndSurround) {
  Scene scene;
  EXPECT_DOUBLE_EQ(measure_levels(scene.frame(), kBox).bright, 90.0);
  scene.target = 200.0;
  const PictureLevels levels = measure_levels(scene.frame(), kBox);
  EXPECT_TRUE(levels.target);
  EXPECT_DOUBLE_EQ(levels.bright, 200.0);
  EXPECT_DOUBLE_EQ(levels.mean, 90.0);
}

TEST(MeasureLevels, ABoxAtTheEdgeOrOutsideIsNoHarm) {
  Scene scene;
  const cv::Mat gray = scene.frame();
  for (const cv::Rect2d box : {cv::Rect2d(-5, -5, 12, 12), cv::Rect2d(315, 235, 20, 20),
                               cv::Rect2d(400, 300, 10, 10), cv::Rect2d(10, 10, 0, 0)})
    EXPECT_GT(measure_levels(gray, box).mean, 0.0);
  EXPECT_FALSE(measure_levels(gray, cv::Rect2d(400, 300, 10, 10)).target);
}

TEST(AutoExposure, BringsADarkPictureToAMiddleLevelAndThenLeavesItAlone) {
  Scene scene{.sky = 20.0, .ground = 20.0, .target = 5.0};
  AutoExposure automatic = controller(scene);
  run(scene, automatic, 100, std::nullopt);
  EXPECT_NEAR(cv::mean(scene.frame())[0], 110.0, 15.0);
  EXPECT_TRUE(run(scene, automatic, 100, std::nullopt).empty());
}

TEST(AutoExposure, BringsATargetsSurroundingsJustBelowSaturation) {
  for (const double target : {10.0, 60.0, 120.0}) {
    Scene scene{.sky = 50.0, .ground = 250.0, .target = target};
    AutoExposure automatic = controller(scene);
    run(scene, automatic, 150, kBox);
    const PictureLevels levels = measure_levels(scene.frame(), kBox);
    EXPECT_NEAR(levels.bright, 200.0, 27.0) << target;  // the ground may saturate as it likes
    EXPECT_LT(levels.bright, 250.0) << target;
    EXPECT_TRUE(run(scene, automatic, 100, kBox).empty()) << target;
  }
}

TEST(AutoExposure, ComesBackFromSaturation) {
  Scene scene{.sky = 90.0, .ground = 40.0, .target = 20.0, .setting = {.exposure_us = 4000.0}};
  scene.sky = 800.0;
  AutoExposure automatic = controller(scene);
  run(scene, automatic, 100, kBox);
  EXPECT_NEAR(measure_levels(scene.frame(), kBox).bright, 200.0, 27.0);
}

TEST(AutoExposure, ApproachesFromOneSideWithoutSwingingBack) {
  Scene scene{.sky = 8.0, .ground = 8.0, .target = 2.0};
  AutoExposure automatic = controller(scene);
  const auto changes = run(scene, automatic, 200, kBox);
  ASSERT_GE(changes.size(), 2U);
  double light = 1000.0;
  for (const ExposureSetting& s : changes) {
    const double next = s.exposure_us * std::pow(10.0, s.gain_dB / 20.0);
    EXPECT_GT(next, light);
    EXPECT_LE(next, 2.001 * light);
    light = next;
  }
}

TEST(AutoExposure, ExhaustsTheExposureBeforeItTouchesTheGain) {
  Scene scene{.sky = 10.0, .ground = 10.0, .target = 3.0};
  AutoExposure automatic = controller(scene);
  for (const ExposureSetting& s : run(scene, automatic, 200, kBox)) {
    EXPECT_LE(s.exposure_us, kLimits.exposure_max_us);
    if (s.gain_dB > 0.0) {
      EXPECT_DOUBLE_EQ(s.exposure_us, kLimits.exposure_max_us);
    }
  }
  EXPECT_GT(scene.setting.gain_dB, 10.0);
}

TEST(AutoExposure, AtTheLimitsItSaysWhatIsMissingAndStopsWriting) {
  Scene scene{.sky = 1.0, .ground = 1.0, .target = 0.0};
  AutoExposure automatic = controller(scene);
  run(scene, automatic, 200, kBox);
  EXPECT_DOUBLE_EQ(scene.setting.gain_dB, kLimits.gain_max_dB);
  EXPECT_TRUE(run(scene, automatic, 50, kBox).empty());
  EXPECT_GT(automatic.missing_factor(), 2.0);
  scene.sky = scene.ground = 60.0;
  run(scene, automatic, 200, kBox);
  EXPECT_DOUBLE_EQ(automatic.missing_factor(), 1.0);
}

TEST(AutoExposure, WritesAtMostOnceInSoManyFrames) {
  Scene scene{.sky = 5.0, .ground = 5.0, .target = 1.0};
  AutoExposure automatic(AutoExposureConfig{.settle_frames = 7}, kLimits, scene.setting);
  int last = -100;
  for (int i = 0; i < 100; ++i) {
    const auto next = automatic.step(measure_levels(scene.frame(), kBox));
    if (!next) continue;
    EXPECT_GT(i - last, 7);
    last = i;
    scene.setting = *next;
    automatic.applied(*next);
  }
  EXPECT_GT(last, 0);
}

}  // namespace
}  // namespace ols::camera
