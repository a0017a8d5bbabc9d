#include "central/filter/motion_model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace ols::fusion {
namespace {

using Eigen::Vector3d;

constexpr Motion kAll[] = {Motion::kConstantVelocity, Motion::kCoordinatedTurn,
                           Motion::kAcceleration};

Vector9 moving(const Vector3d& v, const Vector3d& a = Vector3d::Zero()) {
  Vector9 state;
  state << Vector3d::Zero(), v, a;
  return state;
}

Vector3d position_after(Motion motion, const Vector9& state, double dt_s) {
  const Transition t = transition(motion, state, dt_s, {});
  return state.head<3>() + t.f(0, 1) * state.segment<3>(3) + t.f(0, 2) * state.tail<3>();
}

TEST(MotionModel, WithoutAccelerationAllGoStraightOn) {
  for (const Motion motion : kAll) {
    const Vector3d p = position_after(motion, moving({10, -5, 1}), 2.0);
    EXPECT_NEAR((p - Vector3d(20, -10, 2)).norm(), 0.0, 1e-9) << to_string(motion);
  }
}

TEST(MotionModel, ATurnIsACircle) {
  const double speed = 12.0, rate = 0.5, dt_s = 3.0, radius = speed / rate;
  const Vector3d p =
      position_after(Motion::kCoordinatedTurn, moving({speed, 0, 0}, {0, speed * rate, 0}), dt_s);
  const Vector3d circle(radius * std::sin(rate * dt_s), radius * (1.0 - std::cos(rate * dt_s)),
                        0.0);
  EXPECT_NEAR((p - circle).norm(), 0.0, 1e-9);
}

TEST(MotionModel, SingersAccelerationFades) {
  const MotionConfig config;
  const Vector9 state = moving({10, 0, 0}, {0, 2, 0});
  const double dt_s = config.acceleration_time_s;
  const Transition t = transition(Motion::kAcceleration, state, dt_s, config);
  EXPECT_NEAR(t.f(2, 2), std::exp(-1.0), 1e-9);
}

// A drone may turn as hard as it brakes; a meteor brakes by more than it could turn.
TEST(MotionModel, AcrossThePathNothingSteersHarderThanTheLimit) {
  const MotionConfig config;
  for (const Motion motion : kAll) {
    const Transition slow = transition(motion, moving({600, 0, 0}), 0.1, config);
    EXPECT_EQ(slow.directions, Eigen::Matrix3d::Identity()) << to_string(motion);
  }
  const Vector3d v = 40e3 * Vector3d(1, 2, -2).normalized();
  const Transition fast = transition(Motion::kAcceleration, moving(v), 0.1, config);
  const double ratio = config.across_limit_m_s2 / manoeuvre_sd(v, config);
  const Vector3d along = v.normalized(), across = along.unitOrthogonal();
  EXPECT_LT(ratio, 0.03);
  EXPECT_NEAR(along.dot(fast.directions * along), 1.0, 1e-12);
  EXPECT_NEAR(across.dot(fast.directions * across), ratio * ratio, 1e-12);
  EXPECT_NEAR(along.dot(fast.directions * across), 0.0, 1e-12);
}

TEST(MotionModel, NoiseIsAVarianceThatGrows) {
  for (const Motion motion : kAll) {
    double before = 0.0;
    for (const double dt_s : {0.01, 0.1, 1.0, 5.0}) {
      const Eigen::Matrix3d q = transition(motion, moving({10, 0, 0}), dt_s, {}).q;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(q);
      EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-12 * q.trace()) << to_string(motion);
      EXPECT_GT(q(0, 0), before) << to_string(motion) << ' ' << dt_s;
      before = q(0, 0);
    }
  }
}

TEST(MotionModel, WhoIsFasterMayManoeuvreHarder) {
  const MotionConfig config;
  EXPECT_EQ(manoeuvre_sd(Vector3d::Zero(), config), config.acceleration_sd_m_s2);
  EXPECT_NEAR(manoeuvre_sd({0, 0, 1e4}, config), 3e3, 1.0);
}

}  // namespace
}  // namespace ols::fusion
