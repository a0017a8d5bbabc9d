#include "central/filter/motion_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ols::fusion {
namespace {

Transition constant_velocity(double dt, double disturbance) {
  Transition t;
  t.f << 1.0, dt, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0;
  const double s = disturbance * disturbance;
  t.q << s * dt * dt * dt / 3.0, s * dt * dt / 2.0, 0.0, s * dt * dt / 2.0, s * dt, 0.0, 0.0, 0.0,
      s;
  return t;
}

// Of (position, velocity, acceleration), from white noise of the jerk with this spectral density.
Eigen::Matrix3d from_white_jerk(double dt, double s) {
  const double dt2 = dt * dt, dt3 = dt2 * dt;
  Eigen::Matrix3d q;
  q << s * dt3 * dt2 / 20.0, s * dt2 * dt2 / 8.0, s * dt3 / 6.0, s * dt2 * dt2 / 8.0, s * dt3 / 3.0,
      s * dt2 / 2.0, s * dt3 / 6.0, s * dt2 / 2.0, s * dt;
  return q;
}

double turn_rate(const Vector9& state, double limit_rad_s) {
  const Eigen::Vector3d v = state.segment<3>(3), a = state.tail<3>();
  const double squared = v.squaredNorm();
  if (!(squared > 0.0)) return 0.0;
  return std::min(v.cross(a).norm() / squared, limit_rad_s);
}

// White jerk noise on top of the turn; within one step the turn does not change its noise.
Transition coordinated_turn(double dt, double rate_rad_s, double jerk) {
  Transition t;
  const double angle = rate_rad_s * dt;
  constexpr double kStraight = 1e-4;  // below it, the series of the terms below is exact
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const double s1 = angle < kStraight ? dt : sine / rate_rad_s;
  const double c2 = angle < kStraight ? dt * dt / 2.0 : (1.0 - cosine) / (rate_rad_s * rate_rad_s);
  t.f << 1.0, s1, c2, 0.0, cosine, s1, 0.0, -rate_rad_s * sine, cosine;
  t.q = from_white_jerk(dt, jerk * jerk);
  return t;
}

// Singer's model. For steps short against its time constant, the noise is that of white jerk;
// longer steps are divided.
Transition singer(double dt, double sd, double time_s) {
  const double decay = std::exp(-dt / time_s);
  Transition t;
  t.f << 1.0, dt, time_s * (dt - time_s * (1.0 - decay)), 0.0, 1.0, time_s * (1.0 - decay), 0.0,
      0.0, decay;
  t.q = from_white_jerk(dt, 2.0 * sd * sd / time_s);
  return t;
}

Transition singer_in_steps(double dt, double sd, double time_s) {
  const int steps = std::clamp(static_cast<int>(std::ceil(4.0 * dt / time_s)), 1, 64);
  const Transition one = singer(dt / steps, sd, time_s);
  Transition all = one;
  for (int i = 1; i < steps; ++i) {
    all.q = (one.f * all.q * one.f.transpose() + one.q).eval();
    all.f = (one.f * all.f).eval();
  }
  return all;
}

// A 1-sigma at rest, and its increase with speed.
double grown(double at_rest, double per_speed, const Eigen::Vector3d& velocity) {
  return std::sqrt(at_rest * at_rest + per_speed * per_speed * velocity.squaredNorm());
}

// The manoeuvre's variance in space, over that along the path.
Eigen::Matrix3d directions_of(const Eigen::Vector3d& velocity, double hard, double limit) {
  if (hard <= limit) return Eigen::Matrix3d::Identity();
  const double across = limit * limit / (hard * hard);
  const Eigen::Vector3d along = velocity.normalized();
  return across * Eigen::Matrix3d::Identity() + (1.0 - across) * along * along.transpose();
}

Transition along_the_path(Motion motion, const Vector9& state, double dt_s,
                          const MotionConfig& config, double hard) {
  switch (motion) {
    case Motion::kConstantVelocity:
      return constant_velocity(
          dt_s, grown(config.cruise_sd_m_s2, config.cruise_per_speed_s, state.segment<3>(3)));
    case Motion::kCoordinatedTurn:
      return coordinated_turn(dt_s, turn_rate(state, config.turn_limit_rad_s),
                              config.turn_share * hard);
    case Motion::kAcceleration:
      return singer_in_steps(dt_s, hard, config.acceleration_time_s);
  }
  return {};
}

}  // namespace

const char* to_string(Motion motion) {
  switch (motion) {
    case Motion::kConstantVelocity:
      return "constant-velocity";
    case Motion::kCoordinatedTurn:
      return "coordinated-turn";
    case Motion::kAcceleration:
      return "acceleration";
  }
  return "unknown";
}

double manoeuvre_sd(const Eigen::Vector3d& velocity, const MotionConfig& config) {
  return grown(config.acceleration_sd_m_s2, config.acceleration_per_speed_s, velocity);
}

Transition transition(Motion motion, const Vector9& state, double dt_s,
                      const MotionConfig& config) {
  const Eigen::Vector3d velocity = state.segment<3>(3);
  const double hard = manoeuvre_sd(velocity, config);
  Transition result = along_the_path(motion, state, dt_s, config, hard);
  result.directions = directions_of(velocity, hard, config.across_limit_m_s2);
  return result;
}

}  // namespace ols::fusion
