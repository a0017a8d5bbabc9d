#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/toml_config.h"
#include "edge/tracker/belief.h"
#include "edge/tracker/difference_candidates.h"
#include "edge/tracker/ego_motion.h"
#include "edge/tracker/foreground_mask.h"
#include "edge/tracker/objective.h"
#include "edge/tracker/particle_filter.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace ols {
namespace {

using testing::Backdrop;
using testing::shift_homography;
using testing::SyntheticScene;

TEST(Random, IsStandardNormalAndFixed) {
  Random random(1);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.gaussian();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.03);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.05);
  Random a(3);
  Random b(3);
  EXPECT_EQ(a.gaussian(), b.gaussian());
}

TEST(Patch, SamplesPixelCentres) {
  cv::Mat ramp(60, 60, CV_8U);
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column) {
      ramp.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(2 * column + row);
    }
  }
  // A box of 24x24 around (20, 30): its samples lie half a pixel off the centre.
  const Patch patch = sample_patch({ramp, {0, 0}, 1}, {20.0, 30.0}, {24.0, 24.0});
  EXPECT_NEAR(patch[0], 2 * (20 - 11.5) + (30 - 11.5), 1e-4);
  EXPECT_NEAR(patch[1] - patch[0], 2.0, 1e-4);
  EXPECT_NEAR(patch[kPatchSide] - patch[0], 1.0, 1e-4);
  // Reduced by two, the same place has the same grey value.
  const FrameView half = make_view(ramp, {10, 10, 40, 40}, 2);
  EXPECT_EQ(half.image.cols, 20);
  EXPECT_NEAR(bilinear(half.image, half.x_of(30.0), half.y_of(30.0)), 90.0, 1.0);
}

TEST(Patch, IsBilinearWhereverAndHoweverLargeTheBox) {
  cv::Mat picture(90, 700, CV_8U);
  cv::RNG random(5);
  random.fill(picture, cv::RNG::UNIFORM, 0, 256);
  // Inside, over each border, wider than what is worked on at once, and of an image of few columns.
  const auto expect_bilinear = [](const FrameView& view, const Eigen::Vector2d& pixel,
                                  const Eigen::Vector2d& size_px) {
    const Patch patch = sample_patch(view, pixel, size_px);
    for (int i = 0; i < kPatchArea; ++i) {
      const double u = (i % kPatchSide + 0.5) / kPatchSide - 0.5;
      const double v = (i / kPatchSide + 0.5) / kPatchSide - 0.5;
      const float expected =
          bilinear(view.image, pixel.x() + u * size_px.x(), pixel.y() + v * size_px.y());
      ASSERT_NEAR(patch[static_cast<std::size_t>(i)], expected, 0.01) << i << " of " << size_px;
    }
  };
  const FrameView whole{picture, {0, 0}, 1};
  for (const double width : {3.0, 23.7, 60.0, 400.0, 650.0}) {
    for (const double x : {-5.0, 30.3, 350.6, 699.0}) {
      expect_bilinear(whole, {x, 40.2}, {width, 30.0});
      expect_bilinear(whole, {x, 88.0}, {width, 7.0});
    }
  }
  for (const int columns : {1, 2, 5, 8, 13}) {
    expect_bilinear({picture.colRange(0, columns), {0, 0}, 1}, {columns / 2.0, 20.0}, {9.0, 9.0});
  }
}

TEST(Template, IsEmptyWithoutStructureBeyondNoiseAndGradient) {
  cv::RNG random(6);
  for (const double contrast : {0.0, 12.0}) {
    cv::Mat sky(200, 200, CV_8U);
    for (int row = 0; row < 200; ++row) {
      for (int column = 0; column < 200; ++column) {
        const bool target = std::abs(row - 100) < 3 && std::abs(column - 100) < 4;
        sky.at<std::uint8_t>(row, column) = cv::saturate_cast<std::uint8_t>(
            80.0 + 0.5 * row + random.gaussian(1.5) - (target ? contrast : 0.0));
      }
    }
    const FrameView view{sky, {0, 0}, 1};
    EXPECT_NEAR(pixel_noise(sky), 1.5, 0.3);
    EXPECT_EQ(make_template(view, {100.0, 100.0}, {24.0, 18.0}).empty, contrast == 0.0);
  }
}

// Rough ground all over the picture is no noise that hides a target.
TEST(Template, IsNotEmptyOnRoughGround) {
  cv::RNG random(6);
  cv::Mat ground(200, 200, CV_8U);
  random.fill(ground, cv::RNG::NORMAL, 120.0, 25.0);
  ground(cv::Rect(96, 97, 8, 6)) = 20;
  EXPECT_FALSE(make_template({ground, {0, 0}, 1}, {100.0, 100.0}, {24.0, 18.0}).empty);
}

Template pattern() {
  Template made;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const bool inside =
        i % kPatchSide > 7 && i % kPatchSide < 16 && i / kPatchSide > 7 && i / kPatchSide < 16;
    made.gray[i] = inside ? 40.0F : 150.0F;
  }
  made.contrast = 110.0F;
  return made;
}

TEST(Objective, IsOneForTheTemplateWhateverTheExposure) {
  const Template target = pattern();
  Objective objective(target);
  MaskPatch all;
  all.fill(255);
  objective.set_mask(all);
  Patch brighter = target.gray;
  for (float& value : brighter) value = 0.8F * value + 30.0F;
  for (const Patch& patch : {target.gray, brighter}) {
    EXPECT_NEAR(objective(patch, all).similarity, 1.0, 1e-4);
    EXPECT_NEAR(objective(patch, all).correlation, 1.0, 1e-4);
  }
  Patch blank;
  blank.fill(150.0F);
  EXPECT_LT(objective(blank, all).similarity, 0.8);
  EXPECT_NEAR(objective(blank, all).correlation, 0.0, 1e-6);
}

// Eq. (5): only where both masks say foreground does a pixel count e-fold.
TEST(Objective, WeighsByTheLesserOfBothMasks) {
  const Template target = pattern();
  Objective objective(target);
  MaskPatch all;
  all.fill(255);
  objective.set_mask(all);
  const MaskPatch none{};
  EXPECT_NEAR(objective(target.gray, none).similarity, std::exp(-1.0), 1e-3);
  objective.set_mask(none);
  EXPECT_NEAR(objective(target.gray, all).similarity, 1.0, 1e-4);
}

TEST(MotionModel, MovesByHomographyAndOwnVelocity) {
  MotionModel motion{TrackerConfig{}};
  Particle particle;
  particle.pixel = {100.0, 50.0};
  particle.size_px = {20.0, 10.0};
  particle.velocity_px_s = motion.begin_frame({shift_homography(30.0, -4.0), 0.1}, particle.pixel);
  // Nothing was known of the camera before: the particle goes on as it did in the image.
  EXPECT_NEAR(particle.velocity_px_s.x(), -300.0, 1e-9);
  EXPECT_NEAR((motion.advance(particle).pixel - particle.pixel).norm(), 0.0, 1e-9);
  particle.velocity_px_s = {50.0, 0.0};
  EXPECT_NEAR(motion.advance(particle).pixel.x(), 135.0, 1e-9);
  EXPECT_NEAR(motion.advance(particle).pixel.y(), 46.0, 1e-9);
  EXPECT_NEAR(motion.image_fixed_velocity().x(), -300.0, 1e-9);
  EXPECT_NEAR(motion.velocity_between({100.0, 50.0}, {135.0, 46.0}).x(), 50.0, 1e-9);
}

// A homography that goes and comes back, at another rate of the camera, leaves the motion in the
// image as it was.
TEST(MotionModel, KeepsImageMotionWhenHomographyComesAndGoes) {
  MotionModel motion{TrackerConfig{}};
  Particle particle;
  particle.size_px = {20.0, 10.0};
  motion.begin_frame({shift_homography(30.0, 0.0), 0.1}, {0, 0});
  particle.velocity_px_s = {50.0, 0.0};
  const auto step = [&] { return (motion.advance(particle).pixel - particle.pixel).x(); };
  EXPECT_NEAR(step(), 35.0, 1e-9);
  particle.velocity_px_s += motion.begin_frame({std::nullopt, 0.1}, {0, 0});
  EXPECT_NEAR(step(), 35.0, 1e-9);
  particle.velocity_px_s += motion.begin_frame({shift_homography(10.0, 0.0), 0.1}, {0, 0});
  EXPECT_NEAR(step(), 35.0, 1e-9);
  EXPECT_NEAR(particle.velocity_px_s.x(), 250.0, 1e-9);
}

TEST(MotionModel, KeepsNumbersWithinBounds) {
  Particle particle;
  particle.pixel = {1e93, -1e93};
  particle.velocity_px_s = {-1e93, 1e93};
  particle.size_px = {1e93, 0.0};
  const Particle inside = bounded(particle, {640, 480});
  EXPECT_EQ(inside.pixel, Eigen::Vector2d(1280.0, -480.0));
  EXPECT_EQ(inside.velocity_px_s, Eigen::Vector2d(-6400.0, 6400.0));
  EXPECT_EQ(inside.size_px, Eigen::Vector2d(640.0, 3.0));
  EXPECT_EQ(usable_interval_s(5.0, 1e300), 1.0);
  EXPECT_GT(usable_interval_s(5.0, 5.0 + 1e-12), 1e-5);
}

TEST(ParticleFilter, ResamplesInProportionAndStandsBadWeights) {
  ParticleFilter filter;
  filter.particles().resize(100);
  for (std::size_t i = 0; i < 100; ++i) filter.particles()[i].pixel.x() = i < 50 ? 0.0 : 1.0;
  std::vector<double> logs(100);
  for (std::size_t i = 0; i < 100; ++i) logs[i] = i < 50 ? std::log(3.0) - 900.0 : -900.0;
  filter.weigh(logs);
  Random random(1);
  filter.resample(random);
  double ones = 0.0;
  for (const Particle& particle : filter.particles()) ones += particle.pixel.x();
  EXPECT_NEAR(ones, 25.0, 1.0);
  filter.weigh(std::vector<double>(100, -std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(filter.covariance_about({0.0, 0.0}).allFinite());
}

TEST(EgoMotion, MeasuresTheShiftOfTexture) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  EgoMotionEstimator ego{TrackerConfig{}};
  ego.start(reduce_frame(scene.picture({400, 300}, std::nullopt), 640));
  const auto estimate = ego.step(reduce_frame(scene.picture({412.5, 295}, std::nullopt), 640),
                                 cv::Rect2d(), std::nullopt);
  ASSERT_TRUE(estimate.homography.has_value());
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(20, 20), Eigen::Vector2d(600, 400)}) {
    const Eigen::Vector2d moved = transform(*estimate.homography, pixel) - pixel;
    EXPECT_NEAR(moved.x(), -12.5, 0.3);
    EXPECT_NEAR(moved.y(), 5.0, 0.3);
  }
}

// Corners are followed for some frames, while they leave the picture, and then looked for anew.
TEST(EgoMotion, MeasuresOnWhileTheCameraTurnsOn) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  EgoMotionEstimator ego{TrackerConfig{}};
  cv::Point2d camera(200.0, 300.0);
  ego.start(reduce_frame(scene.picture(camera, std::nullopt), 640));
  for (int frame = 1; frame <= 25; ++frame) {
    const cv::Point2d turned(std::min(5.0 * frame, 35.0), 2.5);
    camera += turned;
    const auto estimate = ego.step(reduce_frame(scene.picture(camera, std::nullopt), 640),
                                   cv::Rect2d(), std::nullopt);
    ASSERT_TRUE(estimate.homography.has_value()) << frame;
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(40, 20), Eigen::Vector2d(600, 460)}) {
      const Eigen::Vector2d moved = transform(*estimate.homography, pixel) - pixel;
      EXPECT_NEAR(moved.x(), -turned.x, 0.3) << frame;
      EXPECT_NEAR(moved.y(), -turned.y, 0.3) << frame;
    }
  }
}

TEST(EgoMotion, FindsAFastTurnFromThePrediction) {
  SyntheticScene scene(Backdrop::kTextured, 2);
  EgoMotionEstimator ego{TrackerConfig{}};
  ego.start(reduce_frame(scene.picture({400, 300}, std::nullopt), 640));
  const auto estimate = ego.step(reduce_frame(scene.picture({600, 300}, std::nullopt), 640),
                                 cv::Rect2d(), shift_homography(-196.0, 2.0));
  ASSERT_TRUE(estimate.homography.has_value());
  EXPECT_NEAR(transform(*estimate.homography, {400, 200}).x(), 200.0, 0.3);
}

TEST(EgoMotion, HasNoneBeforeBlankSky) {
  SyntheticScene scene(Backdrop::kSky, 3, 0.0);
  EgoMotionEstimator ego{TrackerConfig{}};
  ego.start(reduce_frame(scene.picture({400, 300}, std::nullopt), 640));
  const auto estimate = ego.step(reduce_frame(scene.picture({400, 300}, std::nullopt), 640),
                                 cv::Rect2d(), std::nullopt);
  EXPECT_FALSE(estimate.homography.has_value());
  EXPECT_TRUE(estimate.featureless);
}

// Corners on a strip of ground say nothing of the sky: the fit must not fling it about.
TEST(EgoMotion, FitFromAStripStaysCalmElsewhere) {
  cv::RNG random(4);
  std::vector<cv::Point2f> previous;
  std::vector<cv::Point2f> current;
  for (int i = 0; i < 40; ++i) {
    const cv::Point2f p(random.uniform(0.0F, 640.0F), random.uniform(440.0F, 470.0F));
    previous.push_back(p);
    current.push_back(p + cv::Point2f(8.0F + static_cast<float>(random.gaussian(0.3)),
                                      -3.0F + static_cast<float>(random.gaussian(0.3))));
  }
  const Eigen::Matrix3d fitted =
      fit_homography(previous, current, Eigen::Matrix3d::Identity(), {640, 480});
  const Eigen::Vector2d sky = transform(fitted, {320, 50});
  EXPECT_NEAR(sky.x(), 328.0, 3.0);
  EXPECT_NEAR(sky.y(), 47.0, 3.0);
}

// A strip that shears tells of the rest of the picture what no camera does: the paper takes
// RANSAC's word for it, the full mode does not.
TEST(EgoMotion, IsRansacsOwnInPaperMode) {
  cv::Mat before = SyntheticScene(Backdrop::kTextured, 3).picture({400, 300}, std::nullopt);
  before.rowRange(0, 210).setTo(150);
  before.rowRange(270, 480).setTo(150);
  const cv::Mat shear = (cv::Mat_<double>(2, 3) << 1.0, 0.03, -7.2, 0.0, 1.0, 0.0);
  cv::Mat after;
  cv::warpAffine(before, after, shear, before.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  for (const TrackerMode mode : {TrackerMode::kPaper, TrackerMode::kFull}) {
    TrackerConfig config;
    config.mode = mode;
    EgoMotionEstimator estimator(config);
    estimator.start(reduce_frame(before, 640));
    const auto found = estimator.step(reduce_frame(after, 640), {}, std::nullopt).homography;
    ASSERT_TRUE(found.has_value());
    const double off_px = std::abs(transform(*found, {320.0, 0.0}).x() - (320.0 - 7.2));
    EXPECT_EQ(off_px < 1.5, mode == TrackerMode::kPaper) << off_px;
  }
}

TEST(EgoMotion, TellsSenselessHomographies) {
  EXPECT_TRUE(plausible_homography(shift_homography(50, 20), {640, 480}));
  EXPECT_FALSE(plausible_homography(shift_homography(5000, 0), {640, 480}));
  EXPECT_FALSE(plausible_homography(Eigen::Matrix3d::Zero(), {640, 480}));
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(0, 0) = -1.0;
  EXPECT_FALSE(plausible_homography(mirror, {640, 480}));
}

TEST(DifferenceCandidates, AreWhereSomethingMoved) {
  SyntheticScene scene(Backdrop::kSky, 5);
  const auto before = reduce_frame(scene.picture({400, 300}, cv::Point2d(100, 100)), 320);
  const auto after = reduce_frame(scene.picture({400, 300}, cv::Point2d(500, 200)), 320);
  EXPECT_EQ(after.reduction, 2.0);
  const cv::Rect2d all(0.0, 0.0, 640.0, 480.0);
  const auto found = difference_candidates(before, after, std::nullopt, all, {24.0, 18.0}, 4);
  ASSERT_GE(found.size(), 2U);
  for (const Eigen::Vector2d& truth : {Eigen::Vector2d(100, 100), Eigen::Vector2d(500, 200)}) {
    EXPECT_LT(std::min((found[0] - truth).norm(), (found[1] - truth).norm()), 8.0);
  }
  EXPECT_TRUE(difference_candidates(after, after, std::nullopt, all, {24.0, 18.0}, 4).empty());
  const cv::Rect2d left(0.0, 0.0, 300.0, 480.0);
  const auto there = difference_candidates(before, after, std::nullopt, left, {24.0, 18.0}, 4);
  ASSERT_FALSE(there.empty());
  EXPECT_LT((there[0] - Eigen::Vector2d(100, 100)).norm(), 8.0);
  const cv::Rect2d right(400.0, 150.0, 200.0, 100.0);
  const auto other = difference_candidates(before, after, std::nullopt, right, {24.0, 18.0}, 4);
  ASSERT_FALSE(other.empty());
  EXPECT_LT((other[0] - Eigen::Vector2d(500, 200)).norm(), 8.0);
}

TEST(DifferenceCandidates, AreThereForATargetOfHalfThePicture) {
  const auto picture_with = [](const cv::Rect& target) {
    cv::Mat picture(480, 640, CV_8U, cv::Scalar(150));
    picture(target) = 60;
    return reduce_frame(picture, 640);
  };
  const auto before = picture_with({20, 30, 201, 121});
  const auto after = picture_with({320, 230, 201, 121});
  const cv::Rect2d all(0.0, 0.0, 640.0, 480.0);
  const auto found = difference_candidates(before, after, std::nullopt, all, {201.0, 121.0}, 2);
  ASSERT_EQ(found.size(), 2U);
  for (const Eigen::Vector2d& truth : {Eigen::Vector2d(120, 90), Eigen::Vector2d(420, 290)}) {
    EXPECT_LT(std::min((found[0] - truth).norm(), (found[1] - truth).norm()), 30.0);
  }
}

// A camera that turns changes the picture everywhere, and all of it is accounted for.
TEST(DifferenceCandidates, AreOnlyTheTargetOnceTheCameraIsAccountedFor) {
  SyntheticScene scene(Backdrop::kTextured, 5);
  const auto before = reduce_frame(scene.picture({400, 300}, cv::Point2d(100, 100)), 320);
  const auto after = reduce_frame(scene.picture({440, 312}, cv::Point2d(500, 200)), 320);
  const cv::Rect2d all(0.0, 0.0, 640.0, 480.0);
  const auto found =
      difference_candidates(before, after, shift_homography(-40.0, -12.0), all, {24.0, 18.0}, 2);
  ASSERT_EQ(found.size(), 2U);
  for (const Eigen::Vector2d& truth : {Eigen::Vector2d(60, 88), Eigen::Vector2d(500, 200)}) {
    EXPECT_LT(std::min((found[0] - truth).norm(), (found[1] - truth).norm()), 8.0);
  }
}

TEST(ForegroundMask, ShowsTheTargetByAnEarlierAlignedImage) {
  SyntheticScene scene(Backdrop::kTextured, 6);
  const cv::Point2d then(100.0, 100.0);
  const cv::Point2d now(300.0, 240.0);
  ReferenceFrames references(0.1);
  references.offer(scene.picture({400, 300}, then), 0.0, SyntheticScene::box_around(then));
  references.advance(shift_homography(-20.0, 5.0));
  const cv::Mat frame = scene.picture({420, 295}, now);
  const cv::Rect2d box = SyntheticScene::box_around(now);
  EXPECT_EQ(references.without_overlap(SyntheticScene::box_around({80.0, 105.0})), nullptr);
  const auto* reference = references.without_overlap(box);
  ASSERT_NE(reference, nullptr);
  Template target;
  target.contrast = 100.0F;
  target.noise = 3.0F;
  const FrameView mask = foreground_mask(frame, *reference, cv::Rect(200, 150, 200, 180), target);
  const MaskPatch at_target = sample_mask(mask, {now.x, now.y}, {12.0, 8.0});
  const MaskPatch beside = sample_mask(mask, {now.x - 60.0, now.y}, {12.0, 8.0});
  const auto mean = [](const MaskPatch& patch) {
    double sum = 0.0;
    for (const auto value : patch) sum += value;
    return sum / kPatchArea;
  };
  EXPECT_GT(mean(at_target), 150.0);
  EXPECT_LT(mean(beside), 40.0);
}

TEST(Belief, FallsAndRisesOverSomeFrames) {
  Belief belief;
  belief.start();
  const FrameEvidence good{0.9, 0.6, 0.95, 1.0};
  const FrameEvidence gone{0.6, 0.6, 0.1, 0.3};
  for (int i = 0; i < 5; ++i) belief.update(good, 1.0 / 15.0);
  EXPECT_GT(belief.value(), 0.9);
  belief.update(gone, 1.0 / 30.0);
  EXPECT_GT(belief.value(), 0.5);
  for (int i = 0; i < 4; ++i) belief.update(gone, 1.0 / 15.0);
  EXPECT_LT(belief.value(), 0.2);
  belief.update(good, 1.0 / 30.0);
  EXPECT_LT(belief.value(), 0.5);
}

TEST(TrackerConfig, IsReadStrictly) {
  ConfigFile file("[tracker]\nparticles = 500\nsharpness = 9.5\n", "t.toml");
  const TrackerConfig config = read_tracker_config(file.root().table("tracker"));
  EXPECT_EQ(config.particles, 500);
  EXPECT_EQ(config.sharpness, 9.5);
  EXPECT_NO_THROW(file.finish());
  ConfigFile few("[tracker]\nparticles = 3\n", "t.toml");
  EXPECT_THROW(read_tracker_config(few.root().table("tracker")), ConfigError);
  ConfigFile unknown("[tracker]\nparticle = 300\n", "t.toml");
  read_tracker_config(unknown.root().table("tracker"));
  EXPECT_THROW(unknown.finish(), ConfigError);
}

}  // namespace
}  // namespace ols
