// Turns goals into the commands of a cycle: the servo's answer in counts, only what has changed,
// and halts. Pure.
#pragma once

#include <optional>
#include <string>

#include "edge/ptu/codec.h"
#include "edge/ptu/driver.h"
#include "edge/ptu/start_sequence.h"

namespace ols {

// Why no axis position satisfies both configuration and unit, in words; empty when there are such.
std::string limits_conflict(const PtuLimits& configured, const PtuFacts& facts);

class MotionCommands {
 public:
  // The servo's bounds become the narrower ones of configuration and unit, between which there must
  // be room: no limits_conflict().
  MotionCommands(const PtuConfig& config, const PtuFacts& facts);

  // What to send at `time_s`, with the unit at `now`.
  PtuRequest next(const std::optional<ServoGoal>& goal, const PanTilt& now, double time_s);

  // What was sent may not have been understood.
  void send_all_again();

  // Whether the unit can have got to these positions since the last ones; remembers them then. A
  // lost digit has no other mark: replies carry no checksum.
  // `time_s`: when they were read, known to within about `doubt_s`.
  bool plausible(std::int32_t pan_counts, std::int32_t tilt_counts, double time_s, double doubt_s);

  double tilt_rate_rad_s() const { return tilt_.rate_counts_s * tilt_.facts.resolution_rad; }
  const PtuLimits& limits() const { return limits_; }

 private:
  struct Axis {
    PtuAxis name;
    PtuAxisFacts facts;
    std::int32_t least, greatest;                 // within limits_ [counts]
    std::optional<std::int32_t> position, speed;  // as last sent
    std::optional<std::int32_t> read;             // as last seen,
    double rate_counts_s = 0.0;                   // and how fast it moved
    bool rate_known = false;
  };
  static Axis axis(PtuAxis name, const PtuAxisFacts& facts, double least_rad, double greatest_rad);
  void halt(double time_s, PtuRequest& request);
  static void add_speed(Axis& axis, double speed_rad_s, PtuRequest& request);
  static void add_position(Axis& axis, double position_rad, PtuRequest& request);
  bool reachable(const Axis& axis, std::int32_t counts, double dt_s, double doubt_s) const;

  ServoConfig servo_;
  PtuLimits limits_;
  Axis pan_, tilt_;
  double braking_s_ = 0.0;    // from full speed
  double refreshed_s_ = 0.0;  // when everything was sent
  double read_s_ = 0.0;
  double doubt_s_ = 0.0;     // of read_s_
  double read_gap_s_ = 0.0;  // between the last two readings
  std::optional<double> halted_s_;
};

}  // namespace ols
