// A covariance that is none must not be called a position, whatever the geometry.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include "central/estimators/least_squares.h"
#include "central/estimators/paper_triangulation.h"
#include "tests/unit/central/degenerate.h"

namespace ols::fusion {
namespace {

using namespace test;

using Solve = std::function<Estimate(const std::vector<Ray>&)>;

Estimate with_velocity(const std::vector<Ray>& rays) {
  Estimate estimate = least_squares(rays);
  if (estimate.solution == Solution::kOk) estimate_velocity(rays, estimate);
  return estimate;
}

// The mean of two, the second of rays that are known much better.
Estimate averaged(const std::vector<Ray>& rays) {
  const Estimate first = paper_estimate(rays);
  if (first.solution != Solution::kOk) return first;
  std::vector<Ray> better = rays;
  for (Ray& ray : better) ray.sight.covariance_white *= 1e-6;
  const Estimate second = paper_estimate(better);
  if (second.solution != Solution::kOk) return second;
  MovingAverage average(10, 0.3);
  average.add(first, 0);
  return average.add(second, 100'000);
}

const std::pair<const char*, Solve> kSolvers[] = {
    {"least-squares", with_velocity},
    {"paper", [](const auto& rays) { return paper_estimate(rays); }},
    {"paper, centroid",
     [](const auto& rays) { return paper_estimate(rays, {.pairs = PaperPairs::kCentroid}); }},
    {"paper, best baseline",
     [](const auto& rays) { return paper_estimate(rays, {.pairs = PaperPairs::kBestBaseline}); }},
    {"paper, averaged", averaged},
};

// Errors that a station may state besides its noise.
enum class Stated { kNothing, kPointing, kPlace };

void state(std::vector<Ray>& rays, Stated stated) {
  for (Ray& ray : rays) {
    if (stated == Stated::kPointing) {
      ray.sight.covariance_systematic = Eigen::Matrix2d::Identity() * 1e-6;
    } else if (stated == Stated::kPlace) {
      ray.sight.origin_sd_enu_m.setConstant(0.5);
    }
  }
}

TEST(DegenerateGeometry, IsNeverCalledAPositionWithoutACovariance) {
  constexpr std::uint64_t kSeed = 19;
  std::mt19937_64 random(kSeed);
  const auto scenes =
      degenerate_scenes({1e-3, 1.0, 300.0, 2e4, 1e6},
                        {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 30.0});
  for (const auto& [name, solve] : kSolvers) {
    int located = 0, refused = 0, wrong = 0;
    std::string example;
    for (const DegenerateScene& scene : scenes) {
      for (const double sigma_rad : {1e-9, 1e-6, 1e-4, 1e-2}) {
        for (const Stated stated : {Stated::kNothing, Stated::kPointing, Stated::kPlace}) {
          for (const bool noisy : {false, true}) {
            auto rays = rays_of(scene, sigma_rad, noisy ? &random : nullptr);
            state(rays, stated);
            const Estimate estimate = solve(rays);
            ++(estimate.solution == Solution::kOk ? located : refused);
            const std::string claim = false_claim(estimate);
            if (claim.empty()) continue;
            ++wrong;
            example = scene.name + ", sigma " + std::to_string(sigma_rad) + ": " + claim;
          }
        }
      }
    }
    EXPECT_EQ(wrong, 0) << name << ", seed " << kSeed << ", of " << located << " positions; "
                        << example;
    EXPECT_GT(located, 100) << name;
    EXPECT_GT(refused, 100) << name;
  }
}

}  // namespace
}  // namespace ols::fusion
