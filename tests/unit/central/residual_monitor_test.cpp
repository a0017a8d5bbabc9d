#include "central/residual_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "central/least_squares.h"
#include "scene.h"

namespace ols {
namespace {

using test::rays_from;
using test::square;
using test::turned;

constexpr double kSigma = 1e-4;

// Five minutes of epochs; station "b" has this error that stays for each ten seconds.
struct Errors {
  double staying_rad = 0.0;
  double stated_rad = 0.0;
};

struct Learnt {
  double bad_rad = 0.0;   // what is added to b's statement, root mean square of the axes
  double good_rad = 0.0;  // to d's
  double rms = 0.0;       // of b
};

Learnt learn(const Errors& errors, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  ResidualMonitor monitor;
  Eigen::Vector2d staying = Eigen::Vector2d::Zero();
  auto exact = rays_from(square(), {50, 80, 120}, kSigma);
  for (Ray& ray : exact) {
    ray.bearing_variance_rad2 = kSigma * kSigma;
    ray.sight.covariance_systematic.diagonal().setConstant(errors.stated_rad * errors.stated_rad);
  }
  for (int epoch = 0; epoch < 3000; ++epoch) {
    if (epoch % 100 == 0) {
      staying = errors.staying_rad * Eigen::Vector2d(normal(random), normal(random));
    }
    std::vector<Ray> rays = exact;
    for (Ray& ray : rays) {
      ray = turned(ray, kSigma * normal(random), kSigma * normal(random));
      if (ray.station == "b") ray = turned(ray, staying.x(), staying.y());
      monitor.inflate(ray);
    }
    monitor.observe(rays, least_squares(rays), 1'700'000'000'000'000 + epoch * 100'000);
  }
  const auto added = [&](Ray ray) {
    const double before = ray.sight.covariance_systematic.trace();
    monitor.inflate(ray);
    return std::sqrt((ray.sight.covariance_systematic.trace() - before) / 2.0);
  };
  return {added(exact[1]), added(exact[3]), monitor.rms("b")};
}

TEST(ResidualMonitor, LeavesTrueStatementsAlone) {
  const Learnt learnt = learn({}, 1);
  EXPECT_LT(learnt.bad_rad, 0.3 * kSigma);
  EXPECT_LT(learnt.good_rad, 0.3 * kSigma);
  EXPECT_NEAR(learnt.rms, 1.0, 0.15);
}

TEST(ResidualMonitor, FindsAnErrorThatNobodyStated) {
  const Learnt learnt = learn({.staying_rad = 1e-3}, 2);
  EXPECT_GT(learnt.bad_rad, 0.5e-3);
  EXPECT_LT(learnt.bad_rad, 2e-3);
  EXPECT_LT(learnt.good_rad, 0.6 * learnt.bad_rad);
}

TEST(ResidualMonitor, BelievesAStatementUpToItsMargin) {
  EXPECT_EQ(learn({.staying_rad = 1e-3, .stated_rad = 1e-3}, 3).bad_rad, 0.0);
  EXPECT_GT(learn({.staying_rad = 1e-2, .stated_rad = 1e-3}, 4).bad_rad, 3e-3);
}

TEST(ResidualMonitor, KnowsNothingOfStrangers) {
  ResidualMonitor monitor;
  EXPECT_TRUE(std::isnan(monitor.rms("nobody")));
  Ray ray = rays_from(square(), {50, 80, 120})[0];
  const Eigen::Matrix2d before = ray.sight.covariance_systematic;
  monitor.inflate(ray);
  EXPECT_EQ(ray.sight.covariance_systematic, before);
}

}  // namespace
}  // namespace ols
