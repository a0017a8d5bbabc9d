#include "edge/tracker/motion_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::shift_homography;

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

// Eq. (2)-(4): how far 4000 draws spread.
TEST(MotionModel, DisturbsByTheConfiguredNoise) {
  TrackerConfig config;
  config.surprise_fraction = 0.0;
  MotionModel motion(config);
  motion.begin_frame({Eigen::Matrix3d::Identity(), 0.1}, {0.0, 0.0});
  const Particle particle{{50.0, 60.0}, {7.0, -3.0}, {40.0, 10.0}};
  const double sd_px = config.position_sd_px + config.position_sd_fraction * 20.0;
  EXPECT_DOUBLE_EQ(motion.position_sd(particle.size_px), sd_px);
  Random random(1);
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  constexpr int kDraws = 4000;
  for (int k = 0; k < kDraws; ++k) {
    const Particle drawn = motion.disturbed(particle, random);
    squares += Eigen::Vector3d(drawn.pixel.x() - 50.0, drawn.velocity_px_s.y() + 3.0,
                               drawn.size_px.x() / 40.0 - 1.0)
                   .cwiseAbs2() /
               kDraws;
  }
  const double velocity_sd =
      std::hypot(config.velocity_gain * sd_px / 0.1, config.velocity_sd_px_s);
  EXPECT_NEAR(std::sqrt(squares.x()), sd_px, 0.05 * sd_px);
  EXPECT_NEAR(std::sqrt(squares.y()), velocity_sd, 0.05 * velocity_sd);
  EXPECT_NEAR(std::sqrt(squares.z()), config.size_sd_fraction, 0.05 * config.size_sd_fraction);
  motion.begin_frame({std::nullopt, 0.1}, {0.0, 0.0});
  EXPECT_DOUBLE_EQ(motion.position_sd(particle.size_px),
                   std::hypot(sd_px, config.unknown_motion_sd_px));
}

}  // namespace
}  // namespace ols::tracker
