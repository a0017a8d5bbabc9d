// The filter, forwards and smoothed, and the estimators on aligned bearings, in degenerate
// geometry.
#include <gtest/gtest.h>

#include <string>

#include "central/offline/offline_fusion.h"
#include "tests/unit/central/degenerate.h"

namespace ols::fusion {
namespace {

using namespace test;

constexpr std::int64_t kStart = 1'700'000'000'000'000;
constexpr int kExposures = 12;

std::vector<BearingMeasurement> recording_of(const DegenerateScene& scene, double sigma_rad,
                                             bool states_errors, std::mt19937_64& random) {
  std::vector<BearingMeasurement> bearings;
  for (int k = 0; k < kExposures; ++k) {
    for (Ray& ray : rays_of(scene, sigma_rad, &random)) {
      if (states_errors) {
        ray.sight.covariance_systematic = Eigen::Matrix2d::Identity() * 1e-6;
        ray.sight.origin_sd_enu_m.setConstant(0.5);
      }
      bearings.push_back(measurement_of(ray, kStart + k * 100'000));
      bearings.back().clock_sd_s = 1e-3;
    }
  }
  return bearings;
}

struct Mode {
  const char* estimator;
  bool smooth;
};

TEST(DegenerateRecordings, GiveNoPositionWithoutACovariance) {
  constexpr std::uint64_t kSeed = 20;
  std::mt19937_64 random(kSeed);
  const auto scenes = degenerate_scenes({1.0, 300.0, 2e4}, {0.0, 1e-9, 1e-6, 1e-3, 0.1, 1.0});
  for (const Mode& mode : {Mode{"filter", false}, Mode{"filter", true},
                           Mode{"least-squares", false}, Mode{"paper", false}}) {
    OfflineConfig config;
    config.estimator = mode.estimator;
    config.smooth = mode.smooth;
    int located = 0, wrong = 0;
    std::string example;
    for (const DegenerateScene& scene : scenes) {
      for (const double sigma_rad : {1e-6, 1e-3}) {
        for (const bool states_errors : {false, true}) {
          for (const FusedTarget& target :
               fuse_offline(recording_of(scene, sigma_rad, states_errors, random), config)) {
            ++located;
            const std::string claim = false_claim(target.estimate);
            if (claim.empty()) continue;
            ++wrong;
            example = scene.name + ", sigma " + std::to_string(sigma_rad) + ": " + claim;
          }
        }
      }
    }
    EXPECT_EQ(wrong, 0) << mode.estimator << (mode.smooth ? ", smoothed" : "") << ", seed " << kSeed
                        << ", of " << located << "; " << example;
    EXPECT_GT(located, 100) << mode.estimator;
  }
}

}  // namespace
}  // namespace ols::fusion
