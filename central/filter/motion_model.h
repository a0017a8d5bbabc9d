// Three models of a target's motion. All have the same state, so that they can be mixed. Pure.
//
// The state of each axis is (position, velocity, acceleration). The three axes of space share one
// 3x3 transition f and one 3x3 noise q: F = f (x) I and Q = q (x) D. D is I unless the target is
// very fast (see below). The first column of f is (1 0 0), because the position affects neither
// velocity nor acceleration. (Li and Jilkov, "Survey of maneuvering target tracking, part I:
// dynamic models", 2003.)
//  - constant velocity: the acceleration is white noise and is not propagated;
//  - coordinated turn: the acceleration turns with the velocity, w = |v x a| / |v|^2, in the plane
//    of v and a;
//  - acceleration: Singer's model, exponentially correlated.
//
// The assumed acceleration of a manoeuvre grows with the speed. At 10 m/s, the velocity changes by
// a few m/s in a second; at 20 km/s, by some km/s (drag). The same configuration therefore suits a
// drone and a meteor. Drag acts only along the path, and no object turns with more than about 30 g.
// The assumed acceleration across the path is therefore limited. This limit matters at speeds above
// a kilometre per second.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace ols::fusion {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

enum class Motion { kConstantVelocity, kCoordinatedTurn, kAcceleration };
inline constexpr int kMotions = 3;

// "constant-velocity", "coordinated-turn" or "acceleration".
const char* to_string(Motion motion);

struct MotionConfig {
  // The models to mix: at least one, each at most once.
  std::vector<Motion> models = {Motion::kConstantVelocity, Motion::kCoordinatedTurn,
                                Motion::kAcceleration};
  // 1-sigma of a manoeuvre's acceleration: its value at rest, and its increase per speed.
  double acceleration_sd_m_s2 = 3.0;
  double acceleration_per_speed_s = 0.3;  // [1/s]
  double acceleration_time_s = 1.5;       // Singer's correlation time
  double across_limit_m_s2 = 300.0;       // largest 1-sigma across the path
  // 1-sigma of the constant-velocity model's disturbance per root second: its value at rest, and
  // its increase per speed.
  double cruise_sd_m_s2 = 0.2;
  double cruise_per_speed_s = 0.003;  // [1/s]
  double turn_share = 0.1;  // disturbance of the turn model, relative to the acceleration's sd
  double turn_limit_rad_s = 2.0;
  std::array<double, kMotions> dwell_s = {8.0, 4.0,
                                          2.0};  // mean time in each model, in the order of Motion
};

struct Transition {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d q = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d directions =
      // D: the noise in each direction of space, relative to the noise along the path.
      Eigen::Matrix3d::Identity();
};

// 1-sigma of a manoeuvre's acceleration at this velocity [m/s^2].
double manoeuvre_sd(const Eigen::Vector3d& velocity, const MotionConfig& config);

// The transition over dt_s >= 0 from this state (position, velocity, acceleration; three components
// each).
Transition transition(Motion motion, const Vector9& state, double dt_s, const MotionConfig& config);

}  // namespace ols::fusion
