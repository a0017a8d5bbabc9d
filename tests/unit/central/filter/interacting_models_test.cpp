#include "central/filter/interacting_models.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace ols::fusion {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
const FilterStart kCruise{
    .p_ecef = {1, 2, 3}, .v_ecef = {10, 0, 0}, .position_sd_m = 1.0, .velocity_sd_m_s = 0.1};

TEST(InteractingModels, PredictAsTheyLookAhead) {
  InteractingModels models({}, kStart, kCruise);
  const KinematicState ahead = models.at(kStart + 500'000);
  models.predict(kStart + 500'000);
  const KinematicState there = models.kinematics();
  EXPECT_EQ(there.utime_us, kStart + 500'000);
  EXPECT_LT((ahead.mean - there.mean).norm(), 1e-9);
  EXPECT_LT((ahead.covariance - there.covariance).norm(), 1e-9);
  EXPECT_NEAR(position_at(there, kStart).x(), 1.0, 1e-9);
}

TEST(InteractingModels, TheLikelierModelGains) {
  InteractingModels models({}, kStart, kCruise);
  models.weigh(std::array{0.0, -3.0, -50.0});
  const auto& p = models.probabilities();
  EXPECT_GT(p[0], p[1]);
  EXPECT_GT(p[1], p[2]);
  EXPECT_GT(p[2], 0.0);  // none dies
  EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
  const double before = p[0];
  models.interact(1.0);
  EXPECT_LT(models.probabilities()[0], before);
}

TEST(InteractingModels, InflationIsAlongItsDirectionAlone) {
  InteractingModels models({}, kStart, kCruise);
  const Vector3d up(0, 0, 1);
  const Matrix9 before = models.kinematics().covariance;
  models.inflate(1.0, up * up.transpose(), {10, 0, 0});
  const Matrix9 more = models.kinematics().covariance - before;
  EXPECT_GT(more(2, 2), 1.0);
  EXPECT_NEAR(more(0, 0), 0.0, 1e-9);
}

}  // namespace
}  // namespace ols::fusion
