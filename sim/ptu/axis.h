// One axis of the simulated PTU: a stepper motor with trapezoidal speed profiles, in encoder
// counts. It never loses steps by itself; PtuMotion::slip() makes it slip. The motion is stored as
// segments of constant acceleration: the position at any instant follows without stepping.
#pragma once

#include <deque>

namespace ols::sim {

class PtuAxis {
 public:
  // The parameters of a move; all [counts/s] and [counts/s^2], positive.
  struct Profile {
    double speed = 0.0;
    double acceleration = 0.0;
    double base_speed = 0.0;  // the motor starts and stops at this speed without a ramp
  };

  PtuAxis(double position_counts, double time_s);

  // Moves to `target_counts` from any state of motion, and comes to rest there. `time_s` may be in
  // the future; motion planned after it is discarded.
  void move(double target_counts, const Profile& profile, double time_s);

  // Brakes to rest on the next whole count.
  void halt(const Profile& profile, double time_s);

  // The axis slips by `counts` at this instant, and continues its motion from there.
  void shift(double counts, double time_s);

  double position(double time_s) const;  // [counts], continuous
  double velocity(double time_s) const;  // [counts/s]
  // When the axis came to rest or will come to rest.
  double rest_s() const { return segments_.back().start_s; }
  double target() const { return segments_.back().position; }

  // Discards the history before this instant.
  void forget(double before_s);

 private:
  struct Segment {  // constant acceleration from start_s to the next segment's start
    double start_s, position, velocity, acceleration;
  };
  const Segment& segment(double time_s) const;
  void append(double duration_s, double velocity, double acceleration);
  void travel(double target_counts, double entry_speed, const Profile& profile);

  std::deque<Segment> segments_;  // never empty; the last one is at rest
};

}  // namespace ols::sim
