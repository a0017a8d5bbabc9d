#include "central/filter/innovation.h"

#include <gtest/gtest.h>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
const Vector3d kTarget(30, 300, 80), kVelocity(12, 3, -2);

InteractingModels models_at(const Vector3d& p_enu) {
  return {{},
          kStart,
          {.p_ecef = test::site().to_ecef(p_enu),
           .v_ecef = test::site().R_ecef_enu() * kVelocity,
           .position_sd_m = 1.0,
           .velocity_sd_m_s = 1.0}};
}

ModelInnovation seen(const Vector3d& predicted_enu, const Vector3d& measured_enu, double at_s) {
  const BearingMeasurement measurement = test::measurement_of(
      test::ray_to("a", {0, 0, 0}, measured_enu), kStart + std::llround(at_s * 1e6));
  return innovation_of(models_at(predicted_enu), 0, measurement, ray_frame(measurement.sight),
                       nullptr, std::nullopt);
}

TEST(Innovation, IsNoneWhereTheTargetIs) {
  EXPECT_NEAR(seen(kTarget, kTarget, 0.0).residual.norm(), 0.0, 1e-9);
  EXPECT_NEAR(seen(kTarget, kTarget + 0.5 * kVelocity, 0.5).residual.norm(), 0.0, 1e-9);
  EXPECT_NEAR(seen(kTarget, kTarget - 0.5 * kVelocity, -0.5).residual.norm(), 0.0, 1e-9) << "late";
}

TEST(Innovation, ItsJacobianIsTheNumericalOne) {
  constexpr double kStepM = 1e-3;
  const Vector3d measured = kTarget + Vector3d(2, -3, 1);
  const ModelInnovation here = seen(kTarget, measured, 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d step = kStepM * Vector3d::Unit(axis);
    const Eigen::Vector2d moved = seen(kTarget + step, measured, 0.0).residual - here.residual;
    const Vector3d step_ecef = test::site().R_ecef_enu() * step;
    EXPECT_NEAR((moved + here.J * step_ecef).norm(), 0.0,
                1e-4 * (here.J * step_ecef).norm() + 1e-9);
  }
}

TEST(Innovation, BehindTheCameraThereIsNone) {
  EXPECT_LT(seen({0, -300, 0}, kTarget, 0.0).depth_m, 0.0);
  Innovation all;
  EXPECT_FALSE(judge(all, 1, Eigen::Matrix2d::Identity(), 25.0).has_value());
}

TEST(Innovation, AnOutlierTeachesTheNoiseAsOneAtTheGate) {
  Innovation all;
  all.models[0].depth_m = 100.0;
  const Eigen::Matrix2d white = 1e-8 * Eigen::Matrix2d::Identity();
  all.models[0].residual = Eigen::Vector2d(5e-4, 0.0);  // at the gate of 25
  const auto at_gate = judge(all, 1, white, 25.0);
  all.models[0].residual *= 100.0;
  const auto outlier = judge(all, 1, white, 25.0);
  EXPECT_NEAR(at_gate->nis, 25.0, 1e-9);
  EXPECT_GT(outlier->nis, 1e5);
  EXPECT_NEAR(outlier->noise, at_gate->noise, 1e-9);
}

}  // namespace
}  // namespace ols::fusion
