#include "edge/tracker/particle_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

TEST(ParticleFilter, ResamplesInProportionAndStandsBadWeights) {
  ParticleFilter filter;
  filter.particles().resize(100);
  for (std::size_t i = 0; i < 100; ++i) filter.particles()[i].pixel.x() = i < 50 ? 0.0 : 1.0;
  filter.weigh(
      [](const Particle& p) { return p.pixel.x() == 0.0 ? std::log(3.0) - 900.0 : -900.0; });
  Random random(1);
  filter.resample(random);
  EXPECT_EQ(filter.particles().size(), 100U);
  double ones = 0.0;
  for (const Particle& particle : filter.particles()) ones += particle.pixel.x();
  EXPECT_NEAR(ones, 25.0, 1.0);
  filter.weigh([](const Particle&) { return -std::numeric_limits<double>::infinity(); });
  EXPECT_TRUE(filter.covariance_about({0.0, 0.0}).allFinite());
}

TEST(ParticleFilter, MovesEverySecondParticle) {
  ParticleFilter filter;
  filter.particles().assign(4, {{10.0, 20.0}, {0.0, 0.0}, {5.0, 5.0}});
  filter.move_half({3.0, -4.0});
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d at =
        i % 2 == 0 ? Eigen::Vector2d(13.0, 16.0) : Eigen::Vector2d(10.0, 20.0);
    EXPECT_EQ(filter.particles()[i].pixel, at) << i;
  }
}

// Likelihoods that are alike: the one that the motion model predicts.
TEST(ParticleFilter, TakesThePredictedOneOfTwoAlike) {
  MotionModel motion{TrackerConfig{}};
  motion.begin_frame({testing::shift_homography(30.0, 0.0), 0.1}, {100.0, 100.0});
  ParticleFilter filter;
  filter.particles().assign(50, {{100.0, 100.0}, {10.0, 0.0}, {20.0, 20.0}});
  filter.advance(motion);
  for (const Particle& particle : filter.particles()) EXPECT_NEAR(particle.pixel.x(), 131.0, 1e-9);
  Random random(1);
  filter.disturb(motion, random);
  filter.particles()[7].pixel = {131.0, 100.0};
  filter.particles()[9].pixel = {100.0, 100.0};
  filter.weigh([](const Particle& p) {
    const bool either = p.pixel == Eigen::Vector2d(131.0, 100.0) || p.pixel.x() == 100.0;
    return either ? 0.0 : -100.0;
  });
  EXPECT_EQ(filter.maximum_a_posteriori(), 7U);
}

}  // namespace
}  // namespace ols::tracker
