// How a target may move: three models on one state, so that they can be mixed. Pure.
//
// The state of each axis is (position, velocity, acceleration); the three axes of space share one
// 3x3 transition f and one 3x3 noise q, F = f (x) I and Q = q (x) I; no motion
// makes velocity or acceleration of a position, the first column of f is (1 0 0). (Li and Jilkov,
// "Survey of maneuvering target tracking, part I: dynamic models", 2003.)
//  - constant velocity: white noise of the acceleration, which itself is not carried on;
//  - coordinated turn: the acceleration turns with the velocity, w = |v x a| / |v|^2, in the plane
//    of the two, whatever its attitude;
//  - acceleration: Singer's, exponentially correlated.
//
// How hard a target may manoeuvre is taken from how fast it goes: what flies at 10 m/s changes its
// velocity by a few m/s in a second, what flies at 20 km/s by some km/s (drag). So the same numbers
// serve a drone and a meteor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace ols::fusion {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

enum class Motion { kConstantVelocity, kCoordinatedTurn, kAcceleration };
inline constexpr int kMotions = 3;

// "constant-velocity", "coordinated-turn", "acceleration".
const char* to_string(Motion motion);

struct MotionConfig {
  // Those that are mixed: one at least, each once.
  std::vector<Motion> models = {Motion::kConstantVelocity, Motion::kCoordinatedTurn,
                                Motion::kAcceleration};
  // 1-sigma of the acceleration of what manoeuvres: that of a target at rest, and per speed.
  double acceleration_sd_m_s2 = 3.0;
  double acceleration_per_speed_s = 0.3;  // [1/s]
  double acceleration_time_s = 1.5;       // Singer's correlation time
  // The constant velocity's disturbance over the root of a second, likewise.
  double cruise_sd_m_s2 = 0.2;
  double cruise_per_speed_s = 0.003;  // [1/s]
  double turn_share = 0.1;            // of the acceleration's sd, the turn's disturbance
  double turn_limit_rad_s = 2.0;
  std::array<double, kMotions> dwell_s = {8.0, 4.0, 2.0};  // mean time in each, as in Motion
};

struct Transition {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d q = Eigen::Matrix3d::Zero();
};

// 1-sigma of the acceleration that a target of this velocity may have [m/s^2].
double manoeuvre_sd(const Eigen::Vector3d& velocity, const MotionConfig& config);

// Over dt_s >= 0 from this state, (position, velocity, acceleration) of three components each.
Transition transition(Motion motion, const Vector9& state, double dt_s, const MotionConfig& config);

}  // namespace ols::fusion
