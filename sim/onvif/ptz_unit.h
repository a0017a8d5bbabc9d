// The pan-tilt mechanics of a simulated ONVIF PTZ camera, with faults: commands and time in, angles
// out. At power-up the unit is at its home position (0, 0). Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>

#include "geometry/angles.h"
#include "geometry/kinematic_chain.h"
#include "sim/ptu/axis.h"
#include "sim/scenario/faults.h"

namespace ols::sim {

struct PtzUnitConfig {
  PanTilt least{radians(-170.0), radians(-30.0)}, greatest{radians(170.0), radians(90.0)};
  double max_speed_rad_s = radians(60.0);  // of each axis
  double acceleration_rad_s2 = radians(120.0);
  double command_delay_s = 0.08;  // from a command's arrival to the motion
  // 1-sigma of the position error after a move to a position. The reported positions do not
  // contain this error.
  double repeatability_rad = 0.0;
  double boot_s = 20.0;  // time after power-up in which the unit gives no answers
};

class PtzUnit {
 public:
  enum Axis { kPan, kTilt };

  PtzUnit(const PtzUnitConfig& config, std::uint64_t seed, double time_s);

  // Times are of one clock and never decrease, except those of angles_at().
  void set_faults(const PtzFaults& faults, double time_s);

  // Moves at this speed for `lasts_s`; stops at the end of the travel.
  void drive(Axis axis, double speed_rad_s, double lasts_s, double time_s);
  // Moves to a target, which must be within the travel. `speed_rad_s` > 0.
  void go_to(Axis axis, double target_rad, double speed_rad_s, double time_s);
  void stop(double time_s);

  bool answers(double time_s) const { return time_s >= booted_s_; }
  bool moves(double time_s) const;
  // The position that the unit reports; nullopt: it reports none.
  std::optional<PanTilt> reported(double time_s) const;

  // The true shaft angles (pan left positive, tilt up positive), from fifteen seconds ago to now.
  PanTilt angles_at(double time_s) const;

  const PtzUnitConfig& config() const { return config_; }

 private:
  PtuAxis::Profile profile(double speed_rad_s) const;
  PanTilt counted_at(double time_s) const;
  void brake(Axis axis, double time_s);
  void forget(double time_s);

  PtzUnitConfig config_;
  PtzFaults faults_;
  std::array<PtuAxis, 2> axes_;
  std::array<double, 2> missed_rad_{};  // position error of the last move to a position
  std::mt19937_64 random_;
  std::optional<PanTilt> frozen_;
  double booted_s_ = 0.0;
};

}  // namespace ols::sim
